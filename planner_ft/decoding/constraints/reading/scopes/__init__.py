"""The steps in which a filter or perception skill runs, where a task input says so plainly.

scopes, scope_words                scopes by phrases beside the word for a skill
own_sentences                      skills that a sentence of its own asks for: every step
step_scopes, step_scope_words      scopes told against the row of the text's movements
step_meanings, skill_mentions      what such a phrase means in steps, and which words name a skill
"""

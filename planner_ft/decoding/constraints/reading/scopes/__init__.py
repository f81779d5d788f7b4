"""The steps in which a filter or perception skill runs, where a task input says so plainly.

By phrases beside the word for a skill:
    scopes, scope_parts, own_sentences     the reading, the steps that it tells, and skills that a
    sentence of its own asks for: every step scope_clauses, scope_words             the clauses of a
    text and the words in them that count settled_scopes, governing_scopes       what a phrase means
    among the text's movements, and for which skill it holds
Against the row of the text's movements:
    step_scopes, where                     the reading, and the steps that it tells step_rows,
    anchors, step_scope_words   the row, and the phrases of a text in their order step_meanings,
    _kinds, _numbers        what a phrase means in steps mention_places, loose_mentions         the
    steps that each mention of a skill is for skill_mentions, skill_words            which words
    name a skill; text_items: sentences, clauses and items
By places on a path that is known:
    path_scopes, path_spots, path_scope_words
"""

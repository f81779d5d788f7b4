"""The skills and movements that a task input speaks of.

evidence                          skills that it can ask for, by the words of `evidence_words`: for
limits, cameras, measuring and recording evidence_context, evidence_asked  what those words mean in
their surroundings, and where they ask beyond doubt movements, asked                  movements that
it speaks of, and those that it asks for beyond doubt
"""

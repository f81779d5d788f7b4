"""What a task input leaves no choice about, read from its words: waypoints, rotations, and the steps in which other skills run.

Precision comes before coverage: what is read is enforced, and where a reading is not certain the model decides.

    itinerary, own_movement, one_shape, runs, tracks   waypoints, with shapes, cues
    faces, face_wordings, stations, written_out        faces told by an axis, waypoints at intervals, places told from home
    legs, lanes, extents, halts                        legs by bearing and length, grids in any wording, where holds stand
    sequence, sequence_text, sequence_words            whole rows of movements
    turns, turn_forms                                  rotations
    evidence, evidence_words, evidence_context         skills that the text speaks of at all
    evidence_asked, asked                              skills and movements that it asks for in plain words
    told_values                                        values that leave no choice, from:
    named_values, described_values                     text values
    clearances, fences                                 margins to obstacles, lists of corners
    corrected                                          what is taken back
    movements                                          movements that it speaks of
    scopes, scope_words, own_sentences                 steps in which a skill runs
    step_scopes, movement_rows, step_meanings,         the same, told against the row of the text's movements
    step_scope_words, skill_mentions
    telegrams                                          prompts in capitals
    wordings, run_wordings                             patterns that several of them share
"""

LONGEST = 1000
"""Characters of an input that is read: wordings are searched for in every place, and what is longer is no order to a Task Agent."""

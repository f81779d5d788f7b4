"""What a task input leaves no choice about, read from its words: waypoints, rotations, and the steps in which other skills run.

Precision comes before coverage: what is read is enforced, and where a reading is not certain the model decides.

    itinerary, own_movement, one_shape, runs, tracks   waypoints, with shapes, cues
    turns, turn_forms                                  rotations
    evidence, evidence_words, evidence_context         skills that the text speaks of at all
    movements                                          movements that it speaks of
    scopes, scope_words                                steps in which a skill runs
    wordings, run_wordings                             patterns that several of them share
"""

LONGEST = 1000
"""Characters of an input that is read: wordings are searched for in every place, and what is longer is no order to a Task Agent."""

"""The movements of a task input, one after the other.

turns, turn_forms                         rotations: headings to turn to and angles to turn by
turn_angles, angle_wordings               what each angle of a text means sequence, sequence_text,
sequence_words   whole rows, where an input is nothing but movements in plain words movement_rows
which movement of the row a step of a plan belongs to told_movements, movement_words            the
row that a text tells, found by the words for movements
"""

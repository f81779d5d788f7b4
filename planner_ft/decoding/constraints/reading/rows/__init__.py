"""The movements of a task input, one after the other.

turns, turn_forms                         rotations: headings to turn to and angles to turn by
sequence, sequence_text, sequence_words   whole rows, where an input is nothing but movements in plain words
movement_rows                             which movement of the row a step of a plan belongs to
"""

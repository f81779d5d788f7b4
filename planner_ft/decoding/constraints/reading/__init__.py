"""What an input leaves no choice about, read from its words: of a task input waypoints, rotations,
values, and the steps in which skills run.

Precision comes before coverage: what is read is enforced, and where a reading is not certain the
model decides.

    telegrams, corrected   the text itself: prompts in capitals, what is taken back
    wordings               patterns of places, paths and sizes that the folders share
    paths/                 the waypoints of grids, squares, runs, passes, legs and ways off a place
    rows/                  the movements of a text one after the other: rotations, whole rows, their kinds
    skills/                the skills and movements that a text can ask for, and those that it does ask for
    scopes/                the steps in which a filter or perception skill runs
    values/                names, clearances and fences that a text tells beyond doubt
    missions/              values and places of a whole command
"""

LONGEST = 1000
"""Characters of an input that is read: wordings are searched for in every place, and what is longer
is no order to a Task Agent.
"""

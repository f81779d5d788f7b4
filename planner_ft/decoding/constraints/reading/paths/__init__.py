"""The waypoints that a task input leaves no choice about.

itinerary                        grids, squares, stated places and ways off, in order; with `shapes`
for one part of a text own_movement, one_shape, cues    a task that is one handed-down movement, or
one shape with some choice left lanes, extents, halts            how a grid begins and runs, its
sizes, where along it the vehicle holds runs, run_parts, run_wordings    a text searched for all
that leads somewhere: places that it states (`stated_places`) and goes to
                                 (`destinations`), `ways_off` a place and `straight_runs`
tracks                           cable tracks chains, chain_wordings           places, legs and
returns one after the other faces, face_wordings             passes beside a straight thing legs,
stations                   legs by bearing and length, waypoints at even distances written_out
places told from home as coordinates
"""

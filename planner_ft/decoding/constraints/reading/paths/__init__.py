"""The waypoints that a task input leaves no choice about.

itinerary                        grids, squares, stated places and ways off, in order; with `shapes` for one part of a text
own_movement, one_shape, cues    a task that is one handed-down movement, or one shape with some choice left
lanes, extents, halts            how a grid begins and runs, its sizes, where along it the vehicle holds
runs, run_wordings, tracks       straight runs, ways to a place, cable tracks
faces, face_wordings             passes beside a straight thing
legs, stations                   legs by bearing and length, waypoints at even distances
written_out                      places told from home as coordinates
"""

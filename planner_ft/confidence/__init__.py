"""How sure a model is of what it wrote: from the log-probabilities of its tokens (`choices`) over
the parts of a plan (`parts`) to probabilities that were fitted on validation data (`calibration`).
"""

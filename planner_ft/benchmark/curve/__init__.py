"""`plannerft learning-curve`: what more training samples bring."""

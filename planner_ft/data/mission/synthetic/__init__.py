"""Synthetic mission commands with their plans, from phrase banks and the labelling rules."""

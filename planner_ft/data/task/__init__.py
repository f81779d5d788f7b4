"""The task-level data set: prompts and skill plans sampled from a vocabulary."""

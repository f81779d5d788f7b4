"""Prompt templates: prompts written out in full, with slots, and the steps that they ask for."""

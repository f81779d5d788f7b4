"""Whole plans of commands by both agents: field cases, and data that commands demand."""

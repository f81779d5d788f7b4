"""Needed by every part: errors, files, manifests. Imports nothing else of the project."""

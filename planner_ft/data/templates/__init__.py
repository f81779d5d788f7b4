"""Templates of commands and task prompts: one grammar, one JSONL form, one renderer.

The grammar and the files are described in docs/data.md, "Templates".
"""

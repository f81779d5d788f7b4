"""Templates of commands and task prompts (docs/data.md): one grammar, JSONL form and renderer."""

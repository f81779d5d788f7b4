"""Mission level: curated commands and synthetic ones."""

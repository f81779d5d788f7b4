"""Small pure functions over names, plans and the vocabulary, each metric with its definition."""

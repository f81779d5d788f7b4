"""One metric per module: small pure functions over names, plans and the vocabulary, each with its
definition.
"""

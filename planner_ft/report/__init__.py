"""Reports of benchmark runs for people who would rather look than read: one HTML file, figures,
tables, model cards.
"""

"""Reports of benchmark runs to look at: one HTML file, figures, tables, model cards."""

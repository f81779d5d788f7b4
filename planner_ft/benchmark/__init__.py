"""Metrics, statistics, runs that resume, tables and the gate. Scoring imports no torch."""

"""Greedy decoding for every candidate: batched for quality, one query at a time for latency.

`engine.Engine` loads a candidate and answers; `configurations` says with which adapter and how strongly constrained.
"""

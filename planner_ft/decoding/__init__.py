"""Greedy decoding for every candidate: batched for quality, one query at a time for latency.

`engine.Engine` loads a candidate and answers as both agents; `configurations` says with which
adapter and how strongly constrained, `constraints` what a strength allows. `generate` is the loop:
each `row` asks for tokens to be fed, forced and drafted ones (`drafting`, `phrases`) among them,
and takes what the forward pass decides. `passes` computes that pass with transformers, `lean` for
small models on dense weights (`dense`), read by `direct` without transformers.
"""

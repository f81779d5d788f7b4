"""Greedy decoding for every candidate: batched for quality, one query at a time for latency.

`engine.Engine` loads a candidate and answers as both agents; `configurations` says with which
adapter and how strongly constrained, `constraints` what a strength allows. `generate` is the loop:
each sequence (`sequence`) asks for tokens to be fed, forced ones and those of the prompt look-up
(`lookup`) among them, and takes what the forward pass decides.
"""

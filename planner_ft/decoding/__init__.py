"""Greedy decoding for every candidate: batched for quality, one query at a time for latency."""

from planner_ft.decoding.configurations import Configuration, parse_configuration
from planner_ft.decoding.generate import Generation, generate, generate_unordered
from planner_ft.decoding.latency import measure_latency

__all__ = ["Configuration", "Generation", "generate", "generate_unordered", "measure_latency", "parse_configuration"]

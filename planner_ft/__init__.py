"""planner_ft: fine-tune and measure small language models as mission planners for unmanned surface
vehicles.
"""

__version__ = "0.1.0"

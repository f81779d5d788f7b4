"""Adjuncts that several tasks share: stand-off, speed, duration."""

from __future__ import annotations

from planner_ft.data.mission.synthetic.phrases import listed

RADIUS = listed("""
    at {radius}; {radius} off; {radius} out; from {radius} off; from {radius} out; keeping {radius} off; keeping {radius} clear
    with a stand-off of {radius}; at a stand-off of {radius}; at a radius of {radius}; radius {radius}; with {radius} of stand-off
    staying {radius} away; from {radius} away; at {radius} distance; {radius} stand-off; holding {radius} off
""")
DISTANCE = listed("""
    at {distance}; {distance} off; {distance} out; keeping {distance} off; keeping {distance} clear; with a stand-off of {distance}
    at a distance of {distance}; at {distance} distance; stand-off {distance}; staying {distance} away; with {distance} of clearance
    holding {distance} off; {distance} clear of it
""")
SPEED = listed("""
    at {speed}; at a steady {speed}; doing {speed}; making {speed}; speed {speed}; with the speed at {speed}; at a speed of {speed}
    at {speed} over ground; keeping to {speed}; holding {speed}; going {speed}; with speed set to {speed}; throttled to {speed}
""")
DURATION = listed("""
    for {duration}; for the next {duration}; for about {duration}; for a good {duration}; for exactly {duration}; for {duration} straight
    for a total of {duration}; for {duration} in all
""")

"""Values that a task input tells beyond doubt, by skill and parameter.

told_values                        all of them, from:
named_values, described_values     texts named by their kind, or said behind the words for a skill
clearances, fences                 margins to obstacles, lists of corners
"""

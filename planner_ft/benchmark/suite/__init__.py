"""Suites: many candidates on several data sets with one command, one process for each, gone on with
after a kill at any point.
"""

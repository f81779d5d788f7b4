"""The errors that a user can cause."""


class PlannerError(Exception):
    """One sentence with the file, line, flag or value, and the way out. Commands exit with 2."""


class GateError(PlannerError):
    """A figure fell short of its threshold. The command line exits with 1."""


class IncompleteError(PlannerError):
    """Part of a suite could not be measured. The command line exits with 1."""

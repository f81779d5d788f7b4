"""The errors that a user can cause."""


class PlannerError(Exception):
    """One sentence with the file, line, flag or value, and the way out. Commands exit with 2."""


class GateError(PlannerError):
    """A figure fell short of its threshold. The command line exits with 1."""


class IncompleteError(PlannerError):
    """Part of a suite could not be measured. The command line exits with 1."""


class QuestionError(PlannerError):
    """What was asked for is hardly meant: `question` asks, and a word of the user overrules it."""

    def __init__(self, question: str, way_out: str = "") -> None:
        super().__init__(f"{question} {way_out}".strip())
        self.question = question

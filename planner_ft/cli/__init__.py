"""The command line: `plannerft`. Commands parse, call one function of the library and print."""

from __future__ import annotations

import os
import sys

from planner_ft.support.errors import GateError, IncompleteError, PlannerError
from planner_ft.support.terminal import show


def main() -> None:
    """Entry point: a user's mistake is one sentence and exit 2; `--debug` shows a traceback."""
    # OpenMP threads that wait should sleep: spinning ones make a shared machine ten times slower.
    # Read when torch is imported.
    os.environ.setdefault("OMP_WAIT_POLICY", "PASSIVE")
    from planner_ft.cli.app import app

    debug = "--debug" in sys.argv
    if debug:
        sys.argv.remove("--debug")
    try:
        app()
    except PlannerError as error:
        if debug:
            raise
        show(f"plannerft: {error}", error=True)
        sys.exit(1 if isinstance(error, GateError | IncompleteError) else 2)
    except BrokenPipeError:
        # The reader (head, less) closed the pipe: nothing is wrong.
        sys.stderr.close()
        sys.exit(0)

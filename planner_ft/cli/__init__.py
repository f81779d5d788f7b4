"""The command line: `plannerft`. Commands parse, call one function of the library and print."""

import gc
import io
import itertools
import os
import sys

from planner_ft.support.errors import GateError, IncompleteError, PlannerError
from planner_ft.support.terminal import show


def main() -> None:
    """Entry point: a user's mistake is one sentence and exit 2; `--debug` shows a traceback."""
    # OpenMP threads that wait should sleep: spinning ones make a shared machine ten times slower.
    # Read when torch is imported.
    os.environ.setdefault("OMP_WAIT_POLICY", "PASSIVE")
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):  # its encoding may lack what a text holds
            stream.reconfigure(errors="replace")
    debug = "--debug" in sys.argv
    if debug:
        sys.argv.remove("--debug")
    try:
        from planner_ft.cli.app import app

        for option, value in itertools.pairwise(sys.argv[1:]):
            # A variable of a shell that is not set; as a path, it would be the working folder.
            if option.startswith("--") and not value:
                raise PlannerError(f"{option}: is empty; give a value or leave the option out")
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
    except KeyboardInterrupt:
        sys.exit(130)
    except OSError as error:
        if debug:
            raise
        where = error.filename or "the output, or a file that was read or written"
        problem = f"cannot be used ({error.strerror or error})"
        show(f"plannerft: {where}: {problem}; give another path or free some space", error=True)
        sys.exit(2)
    finally:
        gc.freeze()  # The end would look for cycles in all of torch, for half a second.

"""Processes of Python that are forked: the libraries of a start, most of what it costs, are loaded
already.
"""

from __future__ import annotations

import atexit
import os
import runpy
import signal
import subprocess
import sys
import traceback
from typing import Any


class Forked(subprocess.Popen):  # type: ignore[type-arg]
    """Stands in for Popen of `python -m MODULE`, `python -c CODE` or `python SCRIPT`. Signals,
    output and exit status are those of a process of its own; what it imports is there already. Other
    programs start as ever.
    """

    def _execute_child(self, *values: Any) -> None:
        args, _executable, preexec, _close, _pass, _folder, env = values[:7]
        ends, new_session, group = values[10:16], values[-2], values[-1]
        words = [args] if isinstance(args, str) else [os.fspath(word) for word in args]
        if words[0] != sys.executable:
            super()._execute_child(*values)  # type: ignore[misc]
            return
        sys.stdout.flush()
        sys.stderr.flush()
        self.pid = os.fork()
        if not self.pid:
            if new_session:
                os.setsid()
            elif group >= 0:
                os.setpgid(0, group)
            for number, end in enumerate((ends[0], ends[3], ends[5])):
                if end not in (-1, number):
                    os.dup2(end, number)
            if preexec is not None:
                preexec()
            if env is not None:
                os.environ.clear()
                os.environ.update({os.fsdecode(key): os.fsdecode(env[key]) for key in env})
            os._exit(_run([word for word in words[1:] if word != "-u"]))
        self._child_created = True
        self._close_pipe_fds(*ends)  # type: ignore[attr-defined]


def _run(words: list[str]) -> int:
    """The exit status of a program that is given as to Python."""
    sys.stdin, sys.stdout, sys.stderr = (os.fdopen(end, mode) for end, mode in enumerate("rww"))
    signal.signal(signal.SIGINT, signal.default_int_handler)
    atexit._clear()
    status: Any = 0
    try:
        if words[0] == "-m":
            sys.argv = words[1:]
            runpy.run_module(words[1], run_name="__main__", alter_sys=True)
        elif words[0] == "-c":
            sys.argv = ["-c", *words[2:]]
            exec(compile(words[1], "<string>", "exec"), {"__name__": "__main__"})
        else:
            sys.argv = words
            runpy.run_path(words[0], run_name="__main__")
    except SystemExit as left:
        status = left.code
        if isinstance(status, str):
            print(status, file=sys.stderr)
    except BaseException:
        traceback.print_exc()
        status = 1
    atexit._run_exitfuncs()
    sys.stdout.flush()
    sys.stderr.flush()
    return status if isinstance(status, int) else int(status is not None)

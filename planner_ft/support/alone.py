"""One process at a time in an output folder, and nothing left of those that were killed."""

import contextlib
import os
import re
import secrets
import shutil
from collections.abc import Iterator
from pathlib import Path

from planner_ft.support.errors import PlannerError
from planner_ft.support.files import nearest_folder


@contextlib.contextmanager
def alone(folder: Path | None, flag: str, work: str) -> Iterator[None]:
    """Raise PlannerError for a second `work` ("a training") in `folder`, if any. The lock lies
    beside the folder, and a dead process holds none; what dead ones were `staging` is removed.
    """
    if folder is None:
        yield
        return
    from filelock import FileLock, Timeout  # 40 ms

    given, folder = folder, Path(os.path.realpath(folder))
    existing = nearest_folder(folder)
    lock = FileLock(folder.parent / f".{folder.name}.lock")
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        lock.acquire(blocking=False)
        _remove_staged(folder)
    except Timeout:
        if not Path(lock.lock_file).exists():  # in a folder that takes no files, such as /proc
            problem = f"nothing can be written in {folder.parent}"
            raise PlannerError(f"{flag} {given}: {problem}; give another folder") from None
        way_out = "wait for its end, or give another folder"
        raise PlannerError(f"{flag} {given}: {work} runs there; {way_out}") from None
    except OSError:
        pass  # whoever writes into the folder says why that cannot be done
    try:
        yield
    finally:
        with contextlib.suppress(OSError):
            if lock.is_locked:
                Path(lock.lock_file).unlink()
        lock.release()
        with contextlib.suppress(OSError):  # work that was refused leaves no empty folders
            for empty in (folder, *folder.parents):
                if empty == existing:
                    break
                if empty.exists():
                    empty.rmdir()


@contextlib.contextmanager
def staging(folder: Path) -> Iterator[Path]:
    """A folder to fill and move into the place of `folder`, as which errors name it."""
    staged = folder.with_name(f".{folder.name}.{os.getpid()}.{secrets.token_hex(3)}.tmp")
    try:
        staged.mkdir(parents=True)
        yield staged
    except PlannerError as error:
        raise PlannerError(str(error).replace(str(staged), str(folder))) from error
    finally:
        shutil.rmtree(staged, ignore_errors=True)


def _remove_staged(folder: Path) -> None:
    """Only for who is alone in the folder: nobody alive is staging it, or writing a file in it."""
    ending = r"\.[0-9]+\.[0-9a-f]{6}\.tmp"
    staged = re.compile(rf"\.{re.escape(folder.name)}{ending}")
    for path in folder.parent.iterdir():
        if staged.fullmatch(path.name):
            shutil.rmtree(path, ignore_errors=True)
    for path in (*folder.glob(".*.tmp"), *folder.glob("*/.*.tmp")):
        if path.is_file() and re.fullmatch(rf"\..+{ending}", path.name):
            path.unlink()

"""Reading and writing files: atomic writes, JSON Lines with line numbers in errors, digests."""

import contextlib
import csv
import hashlib
import json
import math
import os
import secrets
import shutil
import tomllib
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import IO, Any

from planner_ft.support.errors import PlannerError

DIGITS = 300  # of a whole number at most: a float holds it


def compact_json(value: Any) -> str:
    """JSON without spaces, keys in insertion order, no NaN: plans are trained and compared so."""
    return json.dumps(value, ensure_ascii=False, separators=(",", ":"), allow_nan=False)


def indented_json(value: Any) -> str:
    """JSON for people, with a newline at the end: the form of schemas, manifests and reports."""
    return json.dumps(value, ensure_ascii=False, indent=2, allow_nan=False) + "\n"


@contextlib.contextmanager
def writing(path: Path | str, way: str, what: str = "cannot be written") -> Iterator[None]:
    """An OSError of the block becomes a PlannerError on `path`, `what` happened and the way out."""
    try:
        yield
    except OSError as error:
        raise PlannerError(f"{path}: {what} ({error.strerror or error}); {way}") from error


@contextlib.contextmanager
def atomic_writer(path: Path | str, mode: str = "w") -> Iterator[IO[Any]]:
    """A temporary file beside `path` that replaces it when the block ends without an exception; of a
    link, what it points to. Raises PlannerError (no file, folder not writable, disk full); `path` is
    then as it was.
    """
    given, path = path, Path(os.path.realpath(path))
    if path.exists() and not path.is_file():
        raise PlannerError(f"{given}: is no file that can be replaced; give a file")
    temporary = path.with_name(f".{path.name}.{os.getpid()}.{secrets.token_hex(3)}.tmp")
    try:
        with writing(given, "choose another folder or free some space"):
            path.parent.mkdir(parents=True, exist_ok=True)
            with open(temporary, mode, encoding=None if "b" in mode else "utf-8") as stream:
                yield stream
                stream.flush()
                os.fsync(stream.fileno())
            if path.exists():
                shutil.copymode(path, temporary)
            temporary.replace(path)
    finally:
        with contextlib.suppress(OSError):
            temporary.unlink(missing_ok=True)


def sync_folder(folder: Path) -> None:
    """Have the folder's entries on the disk; Windows cannot, and does so by itself."""
    with contextlib.suppress(OSError):
        descriptor = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)


def nearest_folder(path: Path) -> Path:
    """The folder itself, or the nearest one above that exists."""
    path = path.absolute()
    return next(folder for folder in (path, *path.parents) if folder.exists())


def check_writable(folder: Path) -> None:
    """Raise PlannerError when `folder` cannot be made or written: before the work, not after it."""
    existing = nearest_folder(folder)
    if not existing.is_dir():
        raise PlannerError(f"--out {folder}: {existing} is a file; give a folder")
    if not os.access(existing, os.W_OK | os.X_OK):
        raise PlannerError(f"--out {folder}: {existing} cannot be written; give another --out")


def make_folder(folder: Path) -> None:
    """Make the folder if need be. Raises PlannerError when it cannot be made or written."""
    check_writable(folder)
    with writing(f"--out {folder}", "give another --out", "cannot be made"):
        folder.mkdir(parents=True, exist_ok=True)


def write_text(path: Path | str, text: str) -> None:
    """Write `text` to `path` atomically."""
    with atomic_writer(path) as stream:
        stream.write(text)


def write_json(path: Path | str, value: Any) -> None:
    """Write `value` as indented JSON, atomically."""
    write_text(path, indented_json(value))


def write_jsonl(path: Path | str, records: Iterable[Any]) -> None:
    """Write one compact JSON object per line, atomically."""
    with atomic_writer(path) as stream:
        for record in records:
            stream.write(compact_json(record) + "\n")


def read_text(path: Path | str) -> str:
    """The UTF-8 text of a file. Raises PlannerError when it is missing, unreadable or not UTF-8."""
    path = Path(path)
    try:
        return path.read_text(encoding="utf-8-sig")
    except FileNotFoundError:
        raise PlannerError(f"{path}: no such file") from None
    except UnicodeDecodeError as error:
        reason = f"not UTF-8 text (byte {error.start})"
        raise PlannerError(f"{path}: {reason}; convert it to UTF-8") from None
    except OSError as error:
        raise PlannerError(f"{path}: cannot be read ({error.strerror})") from None


def decode_json(text: str, *, unique: bool = False) -> tuple[Any, int, str | None]:
    """(value, 0, None), or (None, line, problem), if `unique` also a key that stands twice; line 0
    is one that is not known.
    """
    try:
        hook = _unique if unique else None
        value = json.loads(
            text,
            object_pairs_hook=hook,
            parse_float=_finite,
            parse_int=_whole,
            parse_constant=_no_number,
        )
        if "\\u" in text:
            json.dumps(value, ensure_ascii=False).encode()
    except json.JSONDecodeError as error:
        return None, error.lineno, f"not JSON ({error.msg} at column {error.colno})"
    except RecursionError:
        return None, 1, "not JSON that can be read (nested too deeply)"
    except UnicodeEncodeError:
        return None, 1, "not JSON that can be written again (half of a surrogate pair in a string)"
    except ValueError as error:
        return None, 0, f"not JSON ({error})"
    return value, 0, None


def _no_number(name: str) -> None:
    raise ValueError(f"{name} is no JSON number")


def _unique(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for key, value in pairs:
        if key in found:
            raise ValueError(f"the key {key!r} stands twice in an object; keep one")
        found[key] = value
    return found


def read_json(path: Path | str, *, unique: bool = False) -> Any:
    """The value of a JSON file. Raises PlannerError with file, line and column of a mistake, if
    `unique` also for a key that stands twice.
    """
    value, line, problem = decode_json(read_text(path), unique=unique)
    if problem is not None:
        raise PlannerError(f"{path}:{line}: {problem}" if line else f"{path}: {problem}")
    return value


def read_toml(path: Path | str) -> dict[str, Any]:
    """The content of a TOML file. Raises PlannerError."""
    try:
        return tomllib.loads(read_text(path), parse_float=_finite)
    except ValueError as error:
        raise PlannerError(f"{path}: not TOML: {error}") from None
    except RecursionError:
        raise PlannerError(f"{path}: not TOML that can be read (nested too deeply)") from None


def _finite(text: str) -> float:
    value = float(text)
    if not math.isfinite(value):
        raise ValueError(f"{text[:20]} is no number that can be used")
    return value


def _whole(text: str) -> int:
    if len(text) > DIGITS:
        raise ValueError(f"{text[:20]}... is no number that can be used")
    return int(text)


def iterate_jsonl(path: Path | str) -> Iterator[tuple[int, Any | None, str | None]]:
    """(line number, value, None or problem) of every line not blank. Raises PlannerError."""
    # Split on "\n" alone: str.splitlines would also cut at U+2028, which JSON strings may hold.
    for number, line in enumerate(read_text(path).split("\n"), 1):
        if line.strip():
            value, _line, problem = decode_json(line)
            yield number, value, problem


def read_jsonl(path: Path | str) -> list[dict[str, Any]]:
    """The objects of a JSON Lines file. Raises PlannerError at the first bad line, or for none."""
    records = []
    for number, value, problem in iterate_jsonl(path):
        if problem is None and not isinstance(value, dict):
            problem = f"a JSON object is expected, not {type(value).__name__}"
        if problem is not None or value is None:
            raise PlannerError(f"{path}:{number}: {problem}")
        records.append(value)
    if not records:
        raise PlannerError(f"{path}: holds no records")
    return records


def read_csv(path: Path | str) -> list[dict[str, str]]:
    """The lines of a CSV file by its headings. Raises PlannerError."""
    return list(csv.DictReader(read_text(path).splitlines()))


def sha256_file(path: Path | str) -> str:
    """Hexadecimal SHA-256 of a file's bytes."""
    try:
        with open(path, "rb") as stream:
            return hashlib.file_digest(stream, "sha256").hexdigest()
    except OSError as error:
        raise PlannerError(f"{path}: cannot be read ({error.strerror})") from None


def sha256_text(text: str) -> str:
    """Hexadecimal SHA-256 of a text's UTF-8 bytes."""
    return hashlib.sha256(text.encode()).hexdigest()


def sha256_tree(folder: Path | str, patterns: tuple[str, ...] = ("*",)) -> str:
    """One SHA-256 over names and bytes of the files directly in `folder` that match a pattern."""
    digest, found = hashlib.sha256(), {path for one in patterns for path in Path(folder).glob(one)}
    for path in sorted(path for path in found if path.is_file()):
        digest.update(f"{path.name}\0{sha256_file(path)}\n".encode())
    return digest.hexdigest()

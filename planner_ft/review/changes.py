"""What is different between a plan as it was approved and as it is, value by value and by name."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import Any

from planner_ft.document import PlanDocument
from planner_ft.support.files import compact_json

MISSING = "nothing"
LONGEST = 120
"""Characters of a value that are shown."""
DERIVED = (
    "edits",
    "ontology",
    "sources",
    "open_places",
    "warnings",
    "estimate",
    "valid",
    "complete",
)
"""What follows from the rest, or repeats it, and is told last."""
DIGEST = "digest"


@dataclass(frozen=True)
class Change:
    """One value that is different. `text` is for people: "task 2, radius: approved 12, now 20"."""

    path: str
    approved: Any
    now: Any
    text: str

    def as_json(self) -> dict[str, Any]:
        return asdict(self)


def changes(approved: PlanDocument, now: PlanDocument) -> list[Change]:
    """Every difference between two documents; what derives from others (warnings, estimates) comes
    last.
    """
    found = list(_walk("", (), approved, now))
    found.sort(key=lambda change: any(key in DERIVED for key in change.path.split(".")))
    # The digest is another whenever anything is: it says something only where it alone was changed.
    return [change for change in found if change.path != DIGEST] or found


def _walk(path: str, words: tuple[str, ...], before: Any, after: Any) -> Iterator[Change]:
    if isinstance(before, dict) and isinstance(after, dict):
        yield from _walk_keys(path, words, before, after)
    elif (
        isinstance(before, list)
        and isinstance(after, list)
        and _has_ids(before)
        and _has_ids(after)
    ):
        yield from _walk_ids(path, words, before, after)
    elif (
        isinstance(before, list)
        and isinstance(after, list)
        and any(isinstance(item, dict) for item in [*before, *after])
    ):
        yield from _walk_keys(path, words, dict(enumerate(before)), dict(enumerate(after)))
    elif before != after or isinstance(before, bool) != isinstance(after, bool):
        yield Change(
            path,
            before,
            after,
            f"{', '.join(words) or 'the plan'}: approved {_shown(before)}, now {_shown(after)}",
        )


def _walk_keys(
    path: str, words: tuple[str, ...], before: dict[Any, Any], after: dict[Any, Any]
) -> Iterator[Change]:
    for key in [*before, *(key for key in after if key not in before)]:
        here = f"{path}.{key}" if path else str(key)
        named = (*words, *_words(path, key, before.get(key, after.get(key))))
        if key in before and key in after:
            yield from _walk(here, named, before[key], after[key])
        else:
            yield _gone_or_new(here, named, before.get(key), after.get(key))


def _walk_ids(
    path: str, words: tuple[str, ...], before: list[Any], after: list[Any]
) -> Iterator[Change]:
    """Two lists whose items have ids: what is in one alone, what is different, and whether the
    order is.
    """
    old, new = ({item["id"]: item for item in items} for items in (before, after))
    numbers = {
        name: place
        for places in (before, after)
        for place, name in enumerate((item["id"] for item in places), start=1)
    }
    for name in [*old, *(name for name in new if name not in old)]:
        here, named = f"{path}.{name}", (*words[:-1], _item(path, name, numbers[name]))
        if name in old and name in new:
            yield from _walk(here, named, old[name], new[name])
        else:
            yield _gone_or_new(here, named, old.get(name), new.get(name))
    kept = [
        [item["id"] for item in items if item["id"] in old and item["id"] in new]
        for items in (before, after)
    ]
    if kept[0] != kept[1]:
        yield Change(
            path,
            kept[0],
            kept[1],
            f"order of {', '.join(words)}: approved {', '.join(kept[0])}, now {', '.join(kept[1])}",
        )


def _gone_or_new(path: str, words: tuple[str, ...], before: Any, after: Any) -> Change:
    return Change(
        path, before, after, f"{', '.join(words)}: approved {_shown(before)}, now {_shown(after)}"
    )


def _has_ids(items: list[Any]) -> bool:
    ids = [item.get("id") for item in items if isinstance(item, dict)]
    return (
        len(ids) == len(items)
        and len(set(map(str, ids))) == len(ids)
        and all(isinstance(name, str) for name in ids)
    )


def _item(path: str, name: str, number: int) -> str:
    return f"task {number}" if path.endswith("tasks") else name


def _words(path: str, key: Any, value: Any) -> tuple[str, ...]:
    """How people call a key below a path."""
    parent = path.rpartition(".")[2]
    if key in ("parameters", "skill_sequence"):
        return ()
    if parent == "skill_sequence":
        return (f"step {key + 1}",)
    if isinstance(key, int):
        name = value.get("name") if isinstance(value, dict) else None
        return (str(name) if name else f"item {key + 1}",)
    if key == "navigation_skill" and isinstance(value, dict):
        return (str(value.get("name")),)
    return (str(key),)


def _shown(value: Any) -> str:
    text = MISSING if value is None else compact_json(value)
    return text if len(text) <= LONGEST else f"{text[:LONGEST]} ..."

"""Differences between a plan as it was approved and as it is, value by value and by name."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import Any

from planner_ft.document import PlanDocument
from planner_ft.support.files import compact_json

LONGEST = 120
"""Characters of a value that are shown."""
DERIVED = frozenset(
    ["edits", "ontology", "sources", "open_places", "warnings", "estimate", "valid", "complete"]
)
"""Keys that follow from the rest, or repeat it; their changes come last."""
Words = tuple[str, ...]


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
    """Every difference between two documents; derived values (warnings, estimates) come last."""
    found = list(_walk("", (), approved, now))
    found.sort(key=lambda change: not DERIVED.isdisjoint(change.path.split(".")))
    # The digest is another whenever anything is: it counts only where it alone was changed.
    return [change for change in found if change.path != "digest"] or found


def _walk(path: str, words: Words, before: Any, after: Any) -> Iterator[Change]:
    if isinstance(before, dict) and isinstance(after, dict):
        yield from _walk_keys(path, words, before, after)
    elif isinstance(before, list) and isinstance(after, list):
        if _have_ids(before) and _have_ids(after):
            yield from _walk_ids(path, words, before, after)
        elif any(isinstance(item, dict) for item in [*before, *after]):
            yield from _walk_keys(path, words, dict(enumerate(before)), dict(enumerate(after)))
        elif before != after:
            yield _change(path, words, before, after)
    elif before != after or isinstance(before, bool) != isinstance(after, bool):
        yield _change(path, words, before, after)


def _walk_keys(
    path: str, words: Words, before: dict[Any, Any], after: dict[Any, Any]
) -> Iterator[Change]:
    for key in {**before, **after}:
        named = (*words, *_words(path, key, before.get(key, after.get(key))))
        yield from _walk_item(f"{path}.{key}" if path else str(key), named, key, before, after)


def _walk_ids(path: str, words: Words, before: list[Any], after: list[Any]) -> Iterator[Change]:
    """Two lists whose items have ids: changes of each item, then that of the order."""
    old, new = ({item["id"]: item for item in items} for items in (before, after))
    numbers = {name: number for items in (old, new) for number, name in enumerate(items, start=1)}
    for name in {**old, **new}:
        item = f"task {numbers[name]}" if path.endswith("tasks") else name
        yield from _walk_item(f"{path}.{name}", (*words[:-1], item), name, old, new)
    kept = [name for name in old if name in new], [name for name in new if name in old]
    if kept[0] != kept[1]:
        approved, now = (", ".join(names) for names in kept)
        text = f"order of {', '.join(words)}: approved {approved}, now {now}"
        yield Change(path, *kept, text)


def _walk_item(
    path: str, words: Words, key: Any, before: dict[Any, Any], after: dict[Any, Any]
) -> Iterator[Change]:
    if key in before and key in after:
        yield from _walk(path, words, before[key], after[key])
    else:
        yield _change(path, words, before.get(key), after.get(key))


def _change(path: str, words: Words, before: Any, after: Any) -> Change:
    named = ", ".join(words) or "the plan"
    return Change(path, before, after, f"{named}: approved {_shown(before)}, now {_shown(after)}")


def _have_ids(items: list[Any]) -> bool:
    ids = [item.get("id") for item in items if isinstance(item, dict)]
    return len({name for name in ids if isinstance(name, str)}) == len(items)


def _words(path: str, key: Any, value: Any) -> Words:
    """The name of a key below a path, for people."""
    if key in ("parameters", "skill_sequence"):
        return ()
    name = value.get("name") if isinstance(value, dict) else None
    if path.rpartition(".")[2] == "skill_sequence":
        return (f"step {key + 1}",)
    if isinstance(key, int):
        return (str(name) if name else f"item {key + 1}",)
    return (str(name) if key == "navigation_skill" and isinstance(value, dict) else str(key),)


def _shown(value: Any) -> str:
    text = "nothing" if value is None else compact_json(value)
    return text if len(text) <= LONGEST else f"{text[:LONGEST]} ..."

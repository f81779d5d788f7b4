"""Differences between a plan as it was approved and as it is, value by value and by name."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

from planner_ft.document import PlanDocument, altered
from planner_ft.document.edits import replayed
from planner_ft.document.entered import short
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json
from planner_ft.vocabulary import Vocabulary

DERIVED = frozenset(
    ["edits", "ontology", "sources", "open_places", "warnings", "estimate", "valid", "complete"]
)
"""Keys that follow from the rest, or repeat it; their changes come last."""
Words = tuple[str, ...]
MORE = "more than the tasks: the command, the vehicle, the proposal, or the record of changes"


@dataclass(frozen=True)
class Change:
    """One value that is different. `text` is for people: "task 2, radius: approved 12, now 20"."""

    path: str
    approved: Any
    now: Any
    text: str


def tampered(document: PlanDocument, vocabulary: Vocabulary) -> list[Change] | None:
    """What was changed in a plan outside of the review since it was saved; None: nothing was.

    What was saved is the proposal with the edits; where that has not the digest of the file either,
    more was changed than the tasks.
    """
    if not altered(document):
        return None
    try:
        saved = replayed(document, vocabulary)
    except (PlannerError, KeyError, TypeError):
        return [Change("", None, None, MORE)]
    found = changes(saved, {**document, "digest": saved["digest"]})
    named = [replace(one, text=one.text.replace(": approved ", ": saved ", 1)) for one in found]
    return (
        named if saved["digest"] == document.get("digest") else [*named, Change("", "", "", MORE)]
    )


def changes(approved: PlanDocument, now: PlanDocument) -> list[Change]:
    """Every difference between two documents; derived values (warnings, estimates) come last."""
    found = list(_walk("", (), approved, now))
    found.sort(key=lambda change: not DERIVED.isdisjoint(change.path.split(".")))
    # The digest is another whenever anything is: it counts only where it alone was changed.
    return [change for change in found if change.path != "digest"] or found


def _walk(path: str, words: Words, before: Any, after: Any) -> Iterator[Change]:
    keyed = _keyed(before, after)
    if keyed is None:
        if before != after or isinstance(before, bool) != isinstance(after, bool):
            yield _change(path, words, before, after)
        return
    old, new = keyed
    for key in {**old, **new}:
        named = _named(words, path, key, keyed)
        below = f"{path}.{key}" if path else str(key)
        if key in old and key in new:
            yield from _walk(below, named, old[key], new[key])
        else:
            yield _change(below, named, old.get(key), new.get(key))
    if isinstance(before, list):
        kept = [str(key) for key in old if key in new], [str(key) for key in new if key in old]
        if kept[0] != kept[1]:
            approved, now = (", ".join(names) for names in kept)
            text = f"order of {', '.join(words)}: approved {approved}, now {now}"
            yield Change(path, *kept, text)


def _keyed(before: Any, after: Any) -> tuple[dict[Any, Any], dict[Any, Any]] | None:
    """Both values as dictionaries (lists by id, else by place); None: compared as a whole."""
    if isinstance(before, dict) and isinstance(after, dict):
        return before, after
    if not (isinstance(before, list) and isinstance(after, list)):
        return None
    ids = [
        [one.get("id") if isinstance(one, dict) else None for one in of] for of in (before, after)
    ]
    if all(len({name for name in of if isinstance(name, str)}) == len(of) for of in ids):
        return dict(zip(ids[0], before, strict=True)), dict(zip(ids[1], after, strict=True))
    if any(isinstance(item, dict) for item in [*before, *after]):
        return dict(enumerate(before)), dict(enumerate(after))
    return None


def _named(words: Words, path: str, key: Any, keyed: tuple[dict[Any, Any], ...]) -> Words:
    """The name of a key below a path, for people."""
    value = next(entries[key] for entries in keyed if key in entries)
    holder, name = path.rpartition(".")[2], value.get("name") if isinstance(value, dict) else None
    if key in ("parameters", "skill_sequence"):
        return words
    if isinstance(value, dict) and value.get("id") == key:
        place = [*(keyed[1] if key in keyed[1] else keyed[0])].index(key)
        return (*words[:-1], f"task {place + 1}" if holder == "tasks" else str(key))
    if isinstance(key, int):
        if holder == "skill_sequence":
            return (*words, f"step {key + 1}")
        return (*words, str(name or f"item {key + 1}"))
    return (*words, str(name) if name and key == "navigation_skill" else str(key))


def _change(path: str, words: Words, before: Any, after: Any) -> Change:
    named = ", ".join(words) or "the plan"
    return Change(path, before, after, f"{named}: approved {_shown(before)}, now {_shown(after)}")


def _shown(value: Any) -> str:
    return short("nothing" if value is None else compact_json(value))

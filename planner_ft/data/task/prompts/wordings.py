"""All wordings of a template with its values masked, by which a sample of another origin is kept
out of its split.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator, Sequence

from planner_ft.data.task.prompts.language import Choice, Flag, LineText, Node

MOST = 2000  # wordings of one line; what has more is too long to be met by chance

_KEPT = re.compile(r"[^a-z_]+")
_SMALL = frozenset(("the", "a", "an"))


def mask_key(skeleton: str) -> str:
    """A skeleton without case, signs and articles."""
    return " ".join(word for word in _KEPT.sub(" ", skeleton.lower()).split() if word not in _SMALL)


def wordings(line: LineText) -> set[str]:
    """The keys of the line's wordings. A task parameter in words stands for itself alone, as if it
    were a value.
    """
    return {mask_key("".join(parts)) for parts in itertools.islice(_expand(line.text), MOST)}


def _expand(nodes: Sequence[Node]) -> Iterator[tuple[str, ...]]:
    return (
        tuple(itertools.chain.from_iterable(parts))
        for parts in itertools.product(*(_options(node) for node in nodes))
    )


def _options(node: Node) -> list[tuple[str, ...]]:
    if isinstance(node, str):
        return [(node,)]
    if isinstance(node, Flag):
        return [()]
    if isinstance(node, Choice):
        return [
            parts for branch in node.branches for parts in itertools.islice(_expand(branch), MOST)
        ]
    return [("_",)]

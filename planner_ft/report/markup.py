"""HTML and SVG by small functions that escape every text that they are given."""

from __future__ import annotations

import html
from collections.abc import Iterable

VOID = frozenset({"meta", "br", "hr", "input", "col", "link"})


class Markup(str):
    """A text that is markup already and is not escaped again."""

    __slots__ = ()


def text(value: object) -> Markup:
    """A value as escaped text."""
    return value if isinstance(value, Markup) else Markup(html.escape(str(value)))


def join(children: Iterable[object]) -> Markup:
    """Children one after the other; lists are flattened, None is left out."""
    return Markup(
        "".join(
            join(child) if isinstance(child, list | tuple) else text(child)
            for child in children
            if child is not None
        )
    )


def tag(name: str, /, *children: object, **attributes: object) -> Markup:
    """An element. Attribute names lose a last underscore, others become hyphens; None and False
    leave out, True is bare.
    """
    parts = [name]
    for key, value in attributes.items():
        if value is None or value is False:
            continue
        label = key.rstrip("_").replace("_", "-")
        parts.append(label if value is True else f'{label}="{html.escape(_short(value))}"')
    opening = f"<{' '.join(parts)}>"
    return Markup(opening) if name in VOID else Markup(f"{opening}{join(children)}</{name}>")


def _short(value: object) -> str:
    """Coordinates with two decimals at most."""
    return f"{value:.2f}".rstrip("0").rstrip(".") if isinstance(value, float) else str(value)

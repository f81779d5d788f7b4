"""Names and values as BehaviorTree.CPP 4 reads them from XML attributes.

Sources: the library's rules for names (https://github.com/BehaviorTree/BehaviorTree.CPP,
docs/name_validation_rules.md) and for lists in ports, whose entries are set apart by ";"
(https://www.behaviortree.dev/docs/tutorial-basics/tutorial_03_generic_ports).
"""

from __future__ import annotations

import json
import re
import unicodedata
from collections.abc import Iterable
from decimal import Decimal
from typing import Any

from planner_ft.support.files import compact_json
from planner_ft.vocabulary.shape import ParameterType

PORT_TYPES: dict[ParameterType, str] = {
    "position": "std::vector<double>",
    "polygon": "std::vector<double>",
    "number": "double",
    "integer": "int",
    "text": "std::string",
    "id": "std::string",
    "texts": "std::vector<std::string>",
}
RESERVED = frozenset({"name", "ID"})
"""What an attribute of a node means to the library itself; all else that it reserves begins with
"_".
"""

UNREADABLE = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\x7f\ufffe\uffff\ud800-\udfff]")
POINTER_FORM = "its braces became parentheses: in an attribute they would name a blackboard entry"
UNREADABLE_FORM = "its control characters were replaced: XML has none"


def plain_name(text: str, taken: Iterable[str] = ()) -> str:
    """A name for a node, a tree, a port or a blackboard entry: ASCII letters, digits and "_", a
    letter first, none of `taken`.
    """
    ascii_only = unicodedata.normalize("NFKD", text).encode("ascii", "ignore").decode()
    name = re.sub(r"[^A-Za-z0-9_]+", "_", ascii_only).strip("_") or "unnamed"
    name = name if name[0].isalpha() else f"n_{name}"
    others = set(taken)
    candidates = (name, *(f"{name}_{number}" for number in range(2, len(others) + 3)))
    return next(candidate for candidate in candidates if candidate not in others)


def plain_names(texts: Iterable[str], taken: Iterable[str] = ()) -> dict[str, str]:
    """Per text a name that no other text and none of `taken` has."""
    names: dict[str, str] = {}
    for text in texts:
        names.setdefault(text, plain_name(text, (*taken, *names.values())))
    return names


def readable(text: str) -> tuple[str, str]:
    """(the text as an attribute can hold it, how that differs from what was said; "" where it does
    not).
    """
    clean = UNREADABLE.sub("\ufffd", text)
    form = UNREADABLE_FORM if clean != text else ""
    inner = clean.strip(" ")
    if len(inner) > 2 and inner[0] == "{" and inner[-1] == "}":
        return f"({inner[1:-1]})", POINTER_FORM
    # A lone "=" stands for the blackboard entry of the port's own name.
    return ("(=)", POINTER_FORM) if clean == "=" else (clean, form)


def attribute(value: Any) -> tuple[str, str]:
    """(a parameter's value as an attribute's text, how that differs from the value; "" where it
    does not).
    """
    if isinstance(value, str):
        return readable(value)
    if isinstance(value, int | float) and not isinstance(value, bool):
        return _number(value), ""
    if isinstance(value, list) and all(isinstance(item, str) for item in value):
        return _texts(value)
    if isinstance(value, list):
        return (
            ";".join(
                _number(number)
                for item in value
                for number in (item if isinstance(item, list) else [item])
            ),
            "",
        )
    return readable(compact_json(value))


def _texts(items: list[str]) -> tuple[str, str]:
    if any(";" in item or item.startswith("json:") for item in items):
        return readable("json:" + json.dumps(items, ensure_ascii=False))
    return readable(";".join(items))


def _number(value: float) -> str:
    """Decimal digits without an exponent, of exactly this value."""
    return f"{Decimal(repr(value)):f}"

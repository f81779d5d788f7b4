"""`plannerft doctor`: what an issue report needs to say about the machine and the installation."""

from __future__ import annotations

from typing import Annotated, Any

import typer


def doctor(
    json: Annotated[bool, typer.Option("--json", help="Print JSON instead of text.")] = False,
) -> None:
    """Check this installation: versions, devices, 4-bit support (tried, not assumed), disk, caches,
    vocabulary, candidates.

    The report is plain text to paste into an issue. It exits with 0; warnings stand at the end.
    """
    from planner_ft.candidates.diagnosis import diagnose

    found = diagnose()
    if json:
        from json import dumps

        print(dumps({**found.sections, "warnings": found.warnings}, indent=2, ensure_ascii=False))
        return
    for title, entries in found.sections.items():
        print(title)
        for name, value in entries.items():
            print(f"  {name}: {_text(value)}")
    print(f"warnings: {len(found.warnings) or 'none'}")
    for warning in found.warnings:
        print(f"  - {warning}")


def _text(value: Any) -> str:
    if isinstance(value, dict):
        return ", ".join(
            f"{name} {_text(item)}"
            for name, item in value.items()
            if item is not None and item is not False
        )
    return "not set" if value is None else "yes" if value is True else str(value)

"""Texts from templates (jinja2): sentences stand in files of their own, apart from what is counted."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from jinja2 import Template


@functools.cache
def text_template(package: str, name: str) -> Template:
    """A template of plain text in the folder templates/ of a package."""
    from jinja2 import Environment, PackageLoader

    loader = PackageLoader(package)
    return Environment(loader=loader, trim_blocks=True, lstrip_blocks=True).get_template(name)

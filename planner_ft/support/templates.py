"""Texts from templates (jinja2): sentences stand in files of their own, apart from what is counted."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from jinja2 import Environment, Template


def environment(package: str, **options: Any) -> Environment:
    """The templates in the folder templates/ of a package, blocks on lines of their own."""
    from jinja2 import Environment, PackageLoader

    options |= {"trim_blocks": True, "lstrip_blocks": True}
    return Environment(loader=PackageLoader(package), **options)


@functools.cache
def text_template(package: str, name: str) -> Template:
    """A template of plain text."""
    return environment(package).get_template(name)

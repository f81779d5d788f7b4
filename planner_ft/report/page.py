"""report.html: one file that holds everything and asks nobody for anything."""

from __future__ import annotations

import base64
import functools
import hashlib
import re
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from markupsafe import Markup

from planner_ft.report.answers import index, parts, script_json
from planner_ft.report.contents import Section
from planner_ft.report.pictures import NARROW, WIDE, inline_svg

if TYPE_CHECKING:
    from jinja2 import Environment

ASSETS = Path(__file__).parent / "assets"
CAMEL = re.compile(r"(?<=[a-z])(?=[A-Z][a-z])")


def page(sections: Sequence[Section], title: str) -> str:
    """The whole document; its policy allows this style sheet and this script, and no loading."""
    style, script = ((ASSETS / f"report.{kind}").read_text("utf-8") for kind in ("css", "js"))
    policy = f"default-src 'none'; style-src {_hash(style)}; script-src {_hash(script)};"
    policy += " base-uri 'none'; form-action 'none'"
    trusted = {"style": Markup(style), "script": Markup(script)}
    template = templates().get_template("page.html.j2")
    return template.render(sections=sections, title=title, policy=policy, **trusted)


@functools.cache
def templates() -> Environment:
    """The templates of the page, with their filters."""
    from jinja2 import Environment, PackageLoader

    blocks: Any = {"trim_blocks": True, "lstrip_blocks": True, "keep_trailing_newline": True}
    loader = PackageLoader("planner_ft.report")
    environment = Environment(loader=loader, autoescape=True, **blocks)
    environment.filters |= {
        # Names in camel case may break where a capital stands.
        "breakable": lambda label: Markup("<wbr>").join(CAMEL.split(label)),
        "drawing": lambda chart, width: Markup(inline_svg(chart, width)),
        "index": lambda tests: Markup(script_json(index(tests))),
        "parts": lambda tests: map(Markup, parts(tests)),
    }
    environment.globals.update(WIDE=WIDE, NARROW=NARROW)
    return environment


def _hash(content: str) -> str:
    return f"'sha256-{base64.b64encode(hashlib.sha256(content.encode()).digest()).decode()}'"

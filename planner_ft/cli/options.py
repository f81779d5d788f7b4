"""Options of the commands: names, kinds, defaults and help texts are all in help.toml."""

from __future__ import annotations

import functools
import inspect
import tomllib
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Annotated, Any, NamedTuple, get_args

import typer

AGAIN = "give --overwrite or another --out"
ABOUT, ARGUMENTS = "about", "arguments"
LEAST = {"seed": 0, "processes": 1}
"""The smallest values of numbers, checked before a command begins."""
KINDS: dict[str, Any] = {"text": str | None, "texts": list[str] | None, "int": int | None}
KINDS |= {"path": Path | None, "paths": list[Path] | None, "float": float | None}


class Options(SimpleNamespace):
    """The options of a command by name; what has no default is None, a flag False."""

    def take(self, *names: str) -> dict[str, Any]:
        """Some of them."""
        return {name: getattr(self, name) for name in names}

    def given(self, *names: str) -> dict[str, Any]:
        """Those of them that were given."""
        values = self.take(*names).items()
        return {name: one for name, one in values if one is not None and one is not False}


class Help(NamedTuple):
    """A help text, the default that is shown instead of the value, and the panel of the option."""

    text: str
    default: str | bool = True
    panel: str | None = None


def command(function: Callable[[Options], None]) -> Callable[..., None]:
    """The command that help.toml describes under the name of `function`."""

    @functools.wraps(function)
    def run(**values: Any) -> None:
        function(Options(**values))

    help_of, described = helps(function.__name__), []
    for item in _options(_texts()["options"].get(function.__name__, "")):
        annotation = _described(item, help_of[item.name])
        described.append(item.replace(annotation=annotation))
    set_parameters(run, described)
    run.__doc__ = _texts()[ABOUT].get(function.__name__, function.__doc__)
    return run


def _options(text: str) -> Iterator[inspect.Parameter]:
    """The options of a command in [options] of help.toml."""
    for item in text.split():
        name, _, kind = item.partition(":")
        kind, has_default, default = kind.partition("=")
        annotation: Any = KINDS[kind.removesuffix("!")] if kind else bool
        value: Any = None if kind else False
        if has_default or kind.endswith("!"):
            annotation = get_args(annotation)[0]
            value = annotation(default) if has_default else inspect.Parameter.empty
        yield inspect.Parameter(
            name, inspect.Parameter.KEYWORD_ONLY, default=value, annotation=annotation
        )


def set_parameters(function: Callable[..., None], parameters: list[inspect.Parameter]) -> None:
    """Have typer see these parameters."""
    function.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
    function.__annotations__ = {item.name: item.annotation for item in parameters}


def helps(name: str) -> dict[str, Help]:
    """The help of a command's parameters by name; what it lacks is that of all commands."""
    texts = _texts()
    found = {key: _help(value) for key, value in texts["shared"].items()}
    for key, value in texts.get(name, {}).items():
        if isinstance(value, dict):
            found |= {option: _help(text, key) for option, text in value.items()}
        else:
            found[key] = _help(value)
    return found


@functools.cache
def _texts() -> dict[str, Any]:
    return tomllib.loads(Path(__file__).with_name("help.toml").read_text(encoding="utf-8"))


def _help(value: str | list[str], panel: str | None = None) -> Help:
    text, *default = [value] if isinstance(value, str) else value
    return Help(text, default[0] if default else True, panel)


def _described(item: inspect.Parameter, help: Help) -> Any:
    if help.panel == ARGUMENTS:
        return Annotated[item.annotation, typer.Argument(help=help.text, show_default=False)]
    # A flag has no --no- form.
    names = (f"--{item.name.replace('_', '-')}",) if item.annotation is bool else ()
    return Annotated[
        item.annotation,
        typer.Option(
            *names,
            help=help.text,
            show_default=help.default,
            rich_help_panel=help.panel,
            min=LEAST.get(item.name),
        ),
    ]


def typed(names: Iterable[str]) -> str:
    """Options as they are typed: "--level, --batch-size"."""
    return ", ".join(f"--{name.replace('_', '-')}" for name in names)

"""Options of the commands: help texts, and of long commands all but the arguments, in help.toml."""

from __future__ import annotations

import functools
import inspect
import tomllib
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path
from typing import Annotated, Any, NamedTuple, TypeVar, get_args

import typer

Command = TypeVar("Command", bound=Callable[..., None])
ABOUT, ARGUMENTS = "about", "arguments"
LEAST = {"seed": 0, "processes": 1}
"""The smallest values of numbers, checked before a command begins."""
KINDS: dict[str, Any] = {"text": str | None, "texts": list[str] | None, "int": int | None}
KINDS |= {"path": Path | None, "paths": list[Path] | None, "float": float | None}


class Help(NamedTuple):
    """A help text, the default that is shown instead of the value, and the panel of the option."""

    text: str
    default: str | bool = True
    panel: str | None = None


def command(function: Command) -> Command:
    """Give a command its options and their help from help.toml."""
    own = inspect.signature(function, eval_str=True).parameters.values()
    parameters = [*own, *_options(_texts()["options"].get(function.__name__, ""))]
    help_of = helps(function.__name__)
    for index, item in enumerate(parameters):
        if item.name in help_of and not hasattr(item.annotation, "__metadata__"):
            parameters[index] = item.replace(annotation=_described(item, help_of[item.name]))
    set_parameters(function, parameters)
    function.__doc__ = _texts()[ABOUT].get(function.__name__, function.__doc__)
    return function


def _options(text: str) -> Iterator[inspect.Parameter]:
    """The options of a command in [options] of help.toml, None where they are not given."""
    for item in text.split():
        name, _, kind = item.partition(":")
        kind, has_default, default = kind.partition("=")
        annotation, value = (KINDS[kind], None) if kind else (bool, False)
        if has_default:
            annotation = get_args(annotation)[0]
            value = annotation(default)
        yield inspect.Parameter(
            name, inspect.Parameter.KEYWORD_ONLY, default=value, annotation=annotation
        )


def set_parameters(function: Callable[..., None], parameters: list[inspect.Parameter]) -> None:
    """Have typer see these parameters, all given by name."""
    known = [item for item in parameters if item.kind is not item.VAR_KEYWORD]
    named = [item.replace(kind=inspect.Parameter.KEYWORD_ONLY) for item in known]
    function.__signature__ = inspect.Signature(named)  # type: ignore[attr-defined]
    function.__annotations__ = {item.name: item.annotation for item in named}


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


def given(values: Mapping[str, Any], *names: str) -> dict[str, Any]:
    """Those of the named options that were given, by name."""
    return {name: values[name] for name in names if values[name] is not None}


def typed(names: Iterable[str]) -> str:
    """Options as they are typed: "--level, --batch-size"."""
    return ", ".join(f"--{name.replace('_', '-')}" for name in names)

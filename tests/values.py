"""Values that travel between the parts of the product are made once and shared: none may change."""

from __future__ import annotations

import dataclasses
import importlib
import pkgutil


def changeable(*names: str) -> list[str]:
    """The dataclasses of modules, or of the modules of packages, that are not frozen."""
    modules = [importlib.import_module(name) for name in names]
    for package in [module for module in modules if hasattr(module, "__path__")]:
        inner = pkgutil.iter_modules(package.__path__, f"{package.__name__}.")
        modules += [importlib.import_module(one.name) for one in inner]
    return [
        f"{module.__name__}.{name}"
        for module in modules
        for name, value in vars(module).items()
        if isinstance(value, type) and dataclasses.is_dataclass(value)
        if value.__module__ == module.__name__ and not value.__dataclass_params__.frozen
    ]

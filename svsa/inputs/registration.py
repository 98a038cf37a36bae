"""Registration by file: a file in a folder adds a kind, and no other code lists it."""

from importlib import import_module
from pkgutil import iter_modules
from types import ModuleType
from typing import TypeVar

T = TypeVar("T")


def import_modules(package: str) -> list[ModuleType]:
    """Import every module of a package, in the order of their names.

    A package's `__init__` calls it, or `find_kinds`, with its own name. Compiled code that depends
    on such a package depends on every file in it (`svsa.numerics.compilation`).
    """
    folder = import_module(package).__path__
    return [import_module(f"{package}.{module.name}") for module in iter_modules(folder)]


def find_kinds(package: str, base: type[T]) -> tuple[type[T], ...]:
    """The classes with a `kind` that derive from `base` in the modules of a package."""
    return tuple(
        found
        for module in import_modules(package)
        for found in vars(module).values()
        if isinstance(found, type) and issubclass(found, base) and _is_kind(found, module)
    )


def _is_kind(found: type, module: ModuleType) -> bool:
    return found.__module__ == module.__name__ and "kind" in getattr(found, "model_fields", {})

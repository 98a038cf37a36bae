"""Registration: a file in a folder, or an entry point of a package, adds a kind."""

from importlib import import_module
from importlib.metadata import EntryPoint
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


def load_entry(entry: EntryPoint, base: type[T], noun: str) -> T | str:
    """Import the object that an entry point declares.

    Args:
        entry: Its name is the `name` of the object.
        base: Class of the object.
        noun: What the object is, for the reason, such as "law".

    Returns:
        The object; the reason as text if its package does not load or contains something else.
    """
    package = entry.dist.name if entry.dist else entry.module
    try:
        found = entry.load()
    except Exception as error:
        reported = f"{type(error).__name__}: {error}"
        return f"the {noun} {entry.name} of the package {package} does not load: {reported}"
    if isinstance(found, base):
        name = getattr(found, "name", "")
        if name == entry.name:
            return found
        contained = f"the {noun} {name}"
    else:
        contained = f"an object of type {type(found).__name__}"
    return f"the package {package} declares the {noun} {entry.name}, but contains {contained}"


def _is_kind(found: type, module: ModuleType) -> bool:
    return found.__module__ == module.__name__ and "kind" in getattr(found, "model_fields", {})

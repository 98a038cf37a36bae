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
    """Find the classes with a `kind` that derive from `base` in the modules of a package."""
    return tuple(
        member
        for module in import_modules(package)
        for member in vars(module).values()
        if isinstance(member, type) and issubclass(member, base) and _is_kind(member, module)
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
        loaded = entry.load()
    except Exception as error:
        reason = f"{type(error).__name__}: {error}"
        return f"the {noun} {entry.name} of the package {package} does not load: {reason}"
    if isinstance(loaded, base):
        name = getattr(loaded, "name", "")
        if name == entry.name:
            return loaded
        contained = f"the {noun} {name}"
    else:
        contained = f"an object of type {type(loaded).__name__}"
    return f"the package {package} declares the {noun} {entry.name}, but contains {contained}"


def _is_kind(member: type, module: ModuleType) -> bool:
    return member.__module__ == module.__name__ and "kind" in getattr(member, "model_fields", {})

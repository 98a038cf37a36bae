"""The compiled functions that Python code calls, and calls of each of them with real arguments."""

import ast
import importlib
import pkgutil
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

from numba.core.dispatcher import Dispatcher

import svsa

COMPILING = {"compiled", "overload", "intrinsic"}
"""Decorators whose functions are called from compiled code only."""
LEFT_OUT = "svsa.evaluation.timing.plant_problem"
"""The comparison with scipy, which is not part of the product."""


def import_library() -> list[ModuleType]:
    """Import every module of the library except the script of the isolated process."""
    names = [module.name for module in pkgutil.walk_packages(svsa.__path__, "svsa.")]
    chosen = [
        name for name in names if not name.startswith((LEFT_OUT, "svsa.teaching.isolation.child"))
    ]
    return [importlib.import_module(name) for name in chosen if not name.endswith("__main__")]


def read_tree(module: ModuleType) -> ast.Module:
    """The module's source as a syntax tree."""
    return ast.parse(Path(module.__file__ or "").read_text())


def find_specialized(trees: Iterable[ast.Module]) -> set[str]:
    """Names of the functions that `svsa.numerics.compilation.specialize` compiles later."""
    return {
        ast.unparse(node.args[0])
        for tree in trees
        for node in ast.walk(tree)
        if isinstance(node, ast.Call) and ast.unparse(node.func) == "specialize"
    }


def find_calls(node: ast.AST, module: ModuleType, specialized: set[str]) -> Iterator[str]:
    """Names of compiled functions that Python code calls in this part of the module."""
    if isinstance(node, ast.FunctionDef):
        decorators = {ast.unparse(one).split("(")[0] for one in node.decorator_list}
        if decorators & COMPILING or node.name in specialized:
            return
    name = node.func.id if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) else ""
    if isinstance(getattr(module, name, None), Dispatcher):
        yield name
    for child in ast.iter_child_nodes(node):
        yield from find_calls(child, module, specialized)


class Recorder:
    """A compiled function that stores the arguments of its last call from Python."""

    def __init__(self, function: Any) -> None:
        self._function = function
        self._numba_type_ = function._numba_type_  # Compiled code calls the function itself.
        self.given: tuple[Any, ...] | None = None

    def __call__(self, *given: Any) -> Any:
        self.given = given
        return self._function(*given)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._function, name)

    def list_results(self) -> list[str]:
        """The types that the function returns to Python, without the types that contain them."""
        signatures: list[Any] = self._function.nopython_signatures
        pending: list[Any] = [one.return_type for one in signatures]
        found = set[str]()
        while pending:
            kind = pending.pop()
            if hasattr(kind, "types"):  # a tuple
                pending += kind.types
            else:
                found.add(type(kind).__name__)
        return sorted(found)

    def call_again(self) -> None:
        """Call the function with the arguments of its last call."""
        assert self.given is not None
        self._function(*self.given)


def record_calls() -> dict[str, Recorder]:
    """Replace every compiled function that Python calls by its recorder, and return them
    by name.
    """
    trees = {module: read_tree(module) for module in import_library()}
    specialized = find_specialized(trees.values())
    names = {one: set(find_calls(tree, one, specialized)) for one, tree in trees.items()}
    found: dict[str, Recorder] = {}
    for module, called in names.items():
        for name in called:
            function = getattr(module, name)
            known = f"{function.py_func.__module__}.{function.py_func.__name__}"
            setattr(module, name, found.setdefault(known, Recorder(function)))
    batch: Any = importlib.import_module("svsa.simulation.loop.batch")
    specialize: Callable[..., Any] = batch._specialize

    def record(*given: Any) -> Recorder:
        return found.setdefault(
            "svsa.simulation.loop.batch.advance_groups", Recorder(specialize(*given))
        )

    batch._specialize = record
    return found

"""What decides the name of the compiled code's cache."""

import ast
from pathlib import Path

import svsa
from svsa.compilation import find_compiled_sources

LIBRARY = Path(svsa.__file__).parent
SOURCES = {path.relative_to(LIBRARY).as_posix() for path in find_compiled_sources()}


def test_every_file_with_a_compiled_function_counts() -> None:
    """Read from the syntax tree, where the library itself looks at the text."""
    decorated = {
        path.relative_to(LIBRARY).as_posix()
        for path in LIBRARY.rglob("*.py")
        for node in ast.walk(ast.parse(path.read_text()))
        if isinstance(node, ast.FunctionDef)
        for decorator in node.decorator_list
        if isinstance(decorator, ast.Name) and decorator.id == "compiled"
    }
    assert decorated
    assert decorated <= SOURCES


def test_what_a_compiled_file_imports_counts_too() -> None:
    assert {"signals.py", "parameters.py", "control/gains.py"} <= SOURCES


def test_files_beside_the_equations_compile_nothing_anew() -> None:
    beside = {
        "cli.py",
        "runtime/session.py",
        "runtime/run.py",
        "runtime/metrics.py",
        "runtime/command.py",
    }
    assert all((LIBRARY / name).exists() for name in beside)
    assert not beside & SOURCES

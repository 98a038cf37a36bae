"""The public functions of the library's reference describe arguments, results and errors."""

import ast
import inspect
import re
import textwrap
from pkgutil import resolve_name

import svsa
from tests.docs.pages import ROOT

REFERENCE = ROOT / "docs/reference/library.md"


def list_public():
    """Names that the reference documents, and those that `svsa` exports."""
    documented = re.findall(r"auto\w+:: ([\w.]+)", REFERENCE.read_text(encoding="utf-8"))
    return {*documented, *(f"svsa.{name}" for name in svsa.__all__)}


def list_functions(found):
    """Public functions and methods of a function, class or module, if defined in `svsa`."""
    if inspect.ismodule(found):
        for name in getattr(found, "__all__", vars(found)):
            if not name.startswith("_") and inspect.isroutine(one := getattr(found, name)):
                yield from list_functions(one)
    elif inspect.isclass(found):
        for name, one in inspect.getmembers(found, inspect.isroutine):
            is_own = getattr(one, "__qualname__", "").endswith(f".{name}")
            if is_own and not name.startswith("_"):
                yield from list_functions(one)
    elif inspect.isroutine(found):
        function = inspect.unwrap(getattr(found, "__func__", found))
        if inspect.isfunction(function) and function.__module__.startswith("svsa."):
            yield function


def is_override(function):
    """Whether a base class has this method; what its docstring describes holds for this one."""
    owner, _, name = function.__qualname__.rpartition(".")
    bases = resolve_name(f"{function.__module__}:{owner}").__mro__[1:] if owner else ()
    return any(name in vars(base) for base in bases)


def list_missing(function):
    """Arguments and sections that the docstring lacks."""
    text = inspect.getdoc(function) or ""
    signature = inspect.signature(function)
    sections = set()
    if signature.return_annotation not in (None, "None"):
        sections.add("Yields" if "Yields:" in text else "Returns")
    code = ast.parse(textwrap.dedent(inspect.getsource(function)))
    if any(isinstance(node, ast.Raise) and node.exc for node in ast.walk(code)):
        sections.add("Raises")
    return [
        *(
            name
            for name in signature.parameters
            if name not in ("self", "cls") and not re.search(rf"(?m)^    \*{{0,2}}{name}: ", text)
        ),
        *(name for name in sections if not re.search(rf"(?m)^{name}:$", text)),
    ]


def test_public_functions_describe_arguments_results_and_errors():
    functions = {one for name in list_public() for one in list_functions(resolve_name(name))}
    described = [one for one in functions if not is_override(one)]
    assert len(described) > 80
    missing = {f"{one.__module__}.{one.__qualname__}": list_missing(one) for one in described}
    assert {name: lacking for name, lacking in missing.items() if lacking} == {}

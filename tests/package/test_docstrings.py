"""Every public function documents its arguments, return value and exceptions."""

import inspect

import pytest

import svsa

FUNCTIONS = [name for name in svsa.__all__ if inspect.isroutine(getattr(svsa, name))]
METHODS = [name for name, one in vars(svsa.Result).items() if inspect.isfunction(one)]


def list_missing(function) -> list[str]:
    """Return the sections that the docstring lacks."""
    signature = inspect.signature(function)
    text = inspect.getdoc(function) or ""
    needed = {
        "Args:": [name for name in signature.parameters if name != "self"],
        "Returns:": signature.return_annotation not in (None, "None", inspect.Signature.empty),
    }
    undocumented = [name for name in needed["Args:"] if f"{name}:" not in text]
    return undocumented + [
        section for section, is_needed in needed.items() if is_needed and section not in text
    ]


@pytest.mark.parametrize("name", FUNCTIONS)
def test_public_function_has_every_section(name):
    function = getattr(svsa, name)
    assert not list_missing(function)
    assert "Raises:" in inspect.getdoc(function)


def test_every_public_function_has_its_own_summary():
    summaries = [inspect.getdoc(getattr(svsa, name)).partition("\n")[0] for name in FUNCTIONS]
    assert len({*summaries}) == len(summaries)


@pytest.mark.parametrize("name", [name for name in METHODS if not name.startswith("_")])
def test_method_of_a_result_has_its_sections(name):
    assert not list_missing(getattr(svsa.Result, name))

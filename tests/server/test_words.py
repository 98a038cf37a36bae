"""Consistent names in paths, requests and answers, with one default."""

from pathlib import Path

from tests.server.schema import SCHEMA

FORMER_WORDS = {"controller", "run"}
ROOT = Path(__file__).parents[2]


def list_names() -> set[str]:
    """Return every name of a field or a parameter in the API."""
    schemas = SCHEMA["components"]["schemas"].values()
    names = {name for schema in schemas for name in schema.get("properties", {})}
    for path in SCHEMA["paths"].values():
        for operation in path.values():
            names |= {parameter["name"] for parameter in operation.get("parameters", ())}
    return names


def test_law_is_no_controller_and_a_run_is_named_by_its_id() -> None:
    names = list_names()
    assert names >= {"law", "run_id", "run_number"}
    assert not names & FORMER_WORDS
    assert not [path for path in SCHEMA["paths"] if path.endswith("/controller")]


def test_ends_of_a_range_are_low_and_high_with_one_name() -> None:
    ends = {"least", "most", "greatest", "lowest", "highest", "min", "max", "minimum", "maximum"}
    fields = {
        f"{model}.{name}": field
        for model, schema in SCHEMA["components"]["schemas"].items()
        for name, field in schema.get("properties", {}).items()
    }
    assert {path for path in fields if path.split(".")[-1] in ends} == set()
    assert not [path for path, field in fields.items() if field.get("deprecated")]


def test_figure_has_its_load_with_any_start() -> None:
    schemas = SCHEMA["components"]["schemas"]
    session, experiment = schemas["FromFigure"], schemas["FigureExperiment"]
    for name in ("law", "load", "comparisons", "effects"):
        default = experiment["properties"][name]["default"]
        assert session["properties"][name]["default"] == default, name

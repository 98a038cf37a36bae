"""One word for one thing: in paths, requests and answers, with one default."""

from svsa_server.app import build_app

FORMER_WORDS = {"controller", "run"}
SCHEMA = build_app().openapi()


def list_names() -> set[str]:
    """Every name that the API gives to a field or a parameter."""
    schemas = SCHEMA["components"]["schemas"].values()
    names = {name for schema in schemas for name in schema.get("properties", {})}
    for path in SCHEMA["paths"].values():
        for operation in path.values():
            names |= {parameter["name"] for parameter in operation.get("parameters", ())}
    return names


def test_a_law_is_no_controller_and_a_run_is_named_by_its_id() -> None:
    names = list_names()
    assert names >= {"law", "run_id", "run_number"}
    assert not names & FORMER_WORDS
    assert not [path for path in SCHEMA["paths"] if path.endswith("/controller")]


def test_a_figure_has_its_load_whatever_starts_it() -> None:
    schemas = SCHEMA["components"]["schemas"]
    session, experiment = schemas["SessionRequest"], schemas["ExperimentRequest"]
    for name in ("law", "load", "rivals", "effects"):
        default = experiment["properties"][name]["default"]
        assert session["properties"][name]["default"] == default, name

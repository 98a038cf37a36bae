"""Scenarios: save one under a name, run any laws in it, open it in a session."""

from typing import Annotated, Literal

from fastapi import Body, Path, Query
from fastapi.responses import Response

from svsa.evaluation.falsifier.file import (
    EXAMPLES,
    forget_scenario,
    format_scenario,
    is_kept,
    keep_scenario,
    list_scenarios,
    open_scenario,
)
from svsa.evaluation.falsifier.scenario import LoadScenario
from svsa_server.access.permissions import INSTRUCTOR_ONLY, OBSERVER, OPERATOR, allow
from svsa_server.jobs.falsifications import run_laws
from svsa_server.problems import UnknownError
from svsa_server.routes.depends import BUSY, REFUSALS, Work
from svsa_server.routing import build_router
from svsa_server.schemas.evaluation.scenario import (
    SCENARIO_EXAMPLE,
    SavedScenario,
    ScenarioRuns,
    ScenarioTraceState,
    describe_kept,
)

router = build_router("/scenarios", tags=["falsifier"], responses=REFUSALS)
Name = Annotated[
    str,
    Path(
        alias="scenario",
        description="Name of the saved scenario",
        pattern=r"^[0-9A-Za-z][0-9A-Za-z_-]{0,63}$",
        examples=["impulse-ndobc"],
    ),
]
_TOML = {"application/toml": {"schema": {"type": "string"}}}


@router.get("")
@allow(OBSERVER)
def list_saved_scenarios() -> list[SavedScenario]:
    """List the saved scenarios of this lab, by name; before the first, the example."""
    scenarios = list_scenarios() or list_scenarios(EXAMPLES)
    return [describe_kept(name, scenario) for name, scenario in scenarios.items()]


@router.post("/runs", responses=BUSY)
@allow(OPERATOR)
async def run_scenario(
    work: Work,
    scenario_runs: Annotated[
        ScenarioRuns, Body(examples=[{"scenario": SCENARIO_EXAMPLE, "laws": ["ndobc"]}])
    ],
) -> ScenarioTraceState:
    """Run laws in a scenario: the outcome of each, and its errors over time."""
    return ScenarioTraceState(
        **await work.run(run_laws, scenario_runs.scenario, scenario_runs.laws)
    )


@router.put("/{scenario}")
@allow(OPERATOR)
def save_scenario(
    name: Name, load_scenario: Annotated[LoadScenario, Body(examples=[SCENARIO_EXAMPLE])]
) -> SavedScenario:
    """Save a scenario under a name that no other one has."""
    keep_scenario(name, load_scenario)
    return describe_kept(name, load_scenario)


@router.get(
    "/{scenario}",
    response_model=SavedScenario,
    responses={200: {"content": _TOML, "description": "The scenario, or its file"}},
)
@allow(OBSERVER)
def read_scenario(
    name: Name,
    written: Annotated[
        Literal["json", "toml"],
        Query(alias="format", description="toml: the file, which `svsa falsify run` takes"),
    ] = "json",
) -> SavedScenario | Response:
    """Read a saved scenario, as JSON or as its TOML file."""
    scenario = _open(name)
    if written == "json":
        return describe_kept(name, scenario)
    named = {"Content-Disposition": f'attachment; filename="{name}.toml"'}
    return Response(format_scenario(scenario), media_type="application/toml", headers=named)


@router.delete("/{scenario}", status_code=204)
@allow(INSTRUCTOR_ONLY)
def delete_scenario(name: Name) -> None:
    """Delete a saved scenario."""
    if not forget_scenario(name):
        raise _refuse(name)


def _open(name: str) -> LoadScenario:
    if not is_kept(name):
        raise _refuse(name)
    return open_scenario(name)


def _refuse(name: str) -> UnknownError:
    return UnknownError(f"No scenario is saved as {name} here; GET /scenarios lists them.")

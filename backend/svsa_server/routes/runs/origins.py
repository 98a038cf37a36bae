"""Configuration and commands of a run, live or recorded: enough to repeat it in a script."""

from collections.abc import Iterable, Mapping

from fastapi import Request

from svsa.runs.definition.command import Command
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.design import Design
from svsa.runs.records import resimulation
from svsa.runs.records.catalogue.entry import RunEntry
from svsa.runs.records.header import BranchPoint, PlantKind, RecordError
from svsa_server.access.permissions import OBSERVER, allow
from svsa_server.routes.depends import REFUSALS, NamedSession, RunId, Runs
from svsa_server.routing import build_router
from svsa_server.runs.opening import choose_opening
from svsa_server.schemas.runs.run import BranchOrigin, GivenCommand, RunOrigin

router = build_router(tags=["runs"], responses=REFUSALS)


@router.get("/sessions/{session}/origin")
@allow(OBSERVER)
async def read_origin(request: Request, hosted: NamedSession) -> RunOrigin:
    """Read the configuration of the session's run at t = 0, and every change since."""
    return _build_origin(
        hosted.session.journal.initial,
        hosted.session.journal.commands,
        (0, hosted.session.run.tick),
        hosted.session.plant,
        request.app.state.design,
    )


@router.get("/runs/{run_id}/origin")
@allow(OBSERVER)
def read_run_origin(request: Request, runs: Runs, run_id: RunId) -> RunOrigin:
    """Read the configuration of a recorded run at t = 0, and every change to its last sample."""
    record = runs.open(run_id)
    configuration, commands = resimulation.read_origin(record)
    origin = _build_origin(
        configuration,
        commands,
        (record.first_tick, record.first_tick + record.tick_count),
        record.header.plant,
        request.app.state.design,
    )
    if origin.plant == "simulated":
        try:
            resimulation.check_simulated(record)
        except RecordError as error:
            return origin.model_copy(update={"problem": str(error)})
    return origin


def name_origin(
    branch_of: BranchPoint | None, known: Mapping[str, RunEntry]
) -> BranchOrigin | None:
    """Return the run that a branch continues, if the list of runs still has it."""
    if branch_of is None:
        return None
    run_id, tick = branch_of.run_id, branch_of.tick
    origin = known.get(run_id)
    if origin is None:
        return BranchOrigin(run_id=run_id, tick=tick, title=None, time_s=None)
    time_s = (tick - origin.first_tick) * origin.period_s
    return BranchOrigin(run_id=run_id, tick=tick, title=origin.title, time_s=time_s)


def _build_origin(
    configuration: Configuration,
    commands: Iterable[Command],
    ticks: tuple[int, int],
    plant: PlantKind,
    design: Design,
) -> RunOrigin:
    opening = choose_opening(configuration, design)
    return RunOrigin(
        configuration=configuration.model_dump(mode="json"),
        commands=[GivenCommand(tick=command.tick, command=command) for command in commands],
        first_tick=ticks[0],
        tick=ticks[1],
        period_s=configuration.sampling.period_s,
        plant=plant,
        opening=opening.request,
        defaults=opening.defaults.model_dump(mode="json"),
        problem=opening.problem if plant == "simulated" else None,
    )

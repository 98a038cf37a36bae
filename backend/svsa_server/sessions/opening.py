"""Open a private session from the source in a request."""

import asyncio

from fastapi import FastAPI

from svsa.actuators.installed import find_mechanism
from svsa.actuators.parameters import SVSA
from svsa.errors import StateError
from svsa.evaluation.falsifier.measure import list_baselines
from svsa.evaluation.ranking.scenarios import find_scenario
from svsa.evaluation.ranking.single_run import build_shown_run
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.design import Lane
from svsa.runs.definition.experiment import build_default_load
from svsa.runs.records.resimulation import check_simulated, read_origin
from svsa.simulation.plant.loads.paper import PaperLoad
from svsa_server.compiled_loops import compile_arm, compile_for
from svsa_server.jobs.falsifications import read_found
from svsa_server.jobs.job import Job
from svsa_server.schemas.lab.opening import (
    FromActuator,
    FromArm,
    FromFalsification,
    FromFigure,
    FromRanking,
    FromRun,
    FromScenario,
    FromSession,
    SessionRequest,
)
from svsa_server.sessions.evaluated_design import build_trial
from svsa_server.sessions.hosted import HostedSession
from svsa_server.sessions.laboratory import Laboratory
from svsa_server.sessions.preparation import start_rehearsal

LOAD_S = 1.0
"""Onset of the load in a session that shows a design, s."""


async def open_session(app: FastAPI, source: SessionRequest, owner: str) -> HostedSession:
    """Open a session.

    Args:
        app: The application.
        source: Source of the session.
        owner: Id of the user; empty in a lab without a class.

    Raises:
        ParameterError: If a value is rejected.
        StateError: If a falsification has no scenario yet, or the maximum number of sessions is
            reached.
        UnknownError: If there is no such session, run or job.
    """
    laboratory: Laboratory = app.state.laboratory
    match source:
        case FromRun():
            record = await asyncio.to_thread(app.state.catalogue.open, source.id)
            check_simulated(record)
            configuration, commands = read_origin(record)
            return await laboratory.branch(configuration, commands, source.tick, source.id, owner)
        case FromRanking():
            scenario = find_scenario(source.scenario)
            shown = await asyncio.to_thread(build_shown_run, scenario, source.row)
            await asyncio.wrap_future(start_rehearsal(shown.configuration))
            return laboratory.create(shown.configuration, owner, shown.alone)
        case FromActuator():
            for law in {source.law, *(lane.law for lane in source.comparisons)}:
                await compile_for(source.actuator, law)
            configuration = await asyncio.to_thread(source.build_configuration)
        case FromArm():
            for law in {source.law, *(lane.law for lane in source.comparisons)}:
                await compile_arm(source.list_actuators(), law)
            configuration = await asyncio.to_thread(source.build_configuration)
        case FromFigure():
            configuration = source.build_configuration(app.state.design)
        case FromScenario():
            configuration = await asyncio.to_thread(source.build_configuration)
        case FromSession():
            tried, _ = build_trial(laboratory.get(source.id).session, source)
            mechanism = find_mechanism(tried.actuator)
            is_svsa = mechanism.name == SVSA
            load = PaperLoad(start_s=LOAD_S) if is_svsa else build_default_load(mechanism, LOAD_S)
            configuration = tried.changed(loads=(load,), comparisons=())
        case FromFalsification():
            configuration = _build_falsified(app.state.jobs.get(source.id, "falsification"))
    await asyncio.wrap_future(start_rehearsal(configuration))
    return laboratory.create(configuration, owner)


def _build_falsified(job: Job) -> Configuration:
    result = None if job.is_under_way else read_found(job.folder)
    if result is None:
        raise StateError(
            f"The falsification {job.id} is {job.status} and has no scenario: it writes one at its"
            " end."
        )
    law, baseline = list_baselines(job.task.adversary.law)
    return result.scenario.build_configuration(law).changed(comparisons=(Lane(law=baseline),))

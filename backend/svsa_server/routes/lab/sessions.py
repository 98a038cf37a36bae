"""Read a session, and run it: start, pause, reset, step, speed, figure, stream."""

from typing import Annotated

from fastapi import Body, Request, WebSocket
from fastapi.responses import JSONResponse

from svsa_server.access.permissions import OBSERVER, OPERATOR, allow
from svsa_server.openapi import UPGRADED
from svsa_server.problems import Problem, answer_problem
from svsa_server.routes.depends import (
    CREATED,
    REFUSALS,
    Locate,
    NamedClient,
    NamedPerson,
    NamedSession,
)
from svsa_server.routes.teaching.course import restore_settings, set_up_step
from svsa_server.routing import build_router
from svsa_server.schemas.evaluation.scenario import SCENARIO_EXAMPLE
from svsa_server.schemas.lab.opening import (
    ExerciseExperiment,
    ExperimentRequest,
    SessionRequest,
    SettingsBeforeExercise,
)
from svsa_server.schemas.lab.session import (
    SessionState,
    SpeedRequest,
    StepRequest,
)
from svsa_server.schemas.lab.stream import StreamMessage, describe_stream, list_stream_parameters
from svsa_server.sessions.cursor import BATCH_PERIOD_S
from svsa_server.sessions.kind import check_svsa
from svsa_server.sessions.opening import open_session
from svsa_server.sessions.state import build_state
from svsa_server.sessions.stream import stream_session
from svsa_server.sessions.waiting import WaitingRoute, run_waiting

router = build_router("/sessions", tags=["session"], responses=REFUSALS, route_class=WaitingRoute)


@router.get("")
@allow(OBSERVER)
async def list_sessions(
    request: Request, _: NamedClient, person: NamedPerson
) -> list[SessionState]:
    """List the sessions of this server; in a class the shared one and those of the caller."""
    hosted = request.app.state.laboratory.sessions.values()
    return [build_state(session) for session in hosted if person.may_see(session.owner)]


@router.post("", status_code=201, responses=CREATED)
@allow(OPERATOR)
async def create_session(
    request: Request,
    locate: Locate,
    _: NamedClient,
    person: NamedPerson,
    source: Annotated[
        SessionRequest,
        Body(
            examples=[
                {"figure": "4a", "comparisons": [{"law": "fl"}]},
                {"from": "actuator", "actuator": "qbmove", "law": "ndobc"},
                {"from": "arm", "arm": "rods", "actuators": ["svsa", "qbmove"]},
                {"from": "run", "id": "20260102-030405-9f8e7d6c", "tick": 500},
                {"from": "session", "id": "lab", "law": "fl"},
                {"from": "falsification", "id": "3f2a9c01b7de"},
                {"from": "scenario", "scenario": SCENARIO_EXAMPLE, "laws": ["ndobc", "fl"]},
                {"from": "ranking", "row": "ndobc_w", "scenario": "rig_4a.negative.0"},
            ]
        ),
    ],
) -> SessionState:
    """Open a private simulated session from a figure, actuator, run, session ….

    The lab ends it automatically when it is unused. It is running; a session from a run is paused.
    """
    hosted = await open_session(request.app, source, person.id)
    locate(f"/sessions/{hosted.session.name}")
    return build_state(hosted)


@router.delete("/{session}", status_code=204)
@allow(OPERATOR)
async def end_session(request: Request, hosted: NamedSession) -> None:
    """End a private session."""
    request.app.state.laboratory.end(hosted.session.name)


@router.get("/{session}")
@allow(OBSERVER)
async def read_session(hosted: NamedSession) -> SessionState:
    """Read the state of a session: time, settings, faults and metrics."""
    return build_state(hosted)


@router.post("/{session}/start")
@allow(OPERATOR)
def start(hosted: NamedSession) -> SessionState:
    """Start or continue the session."""
    hosted.session.start()
    return build_state(hosted)


@router.post("/{session}/pause")
@allow(OBSERVER)
def pause(hosted: NamedSession) -> SessionState:
    """Pause the session; its state stays."""
    hosted.session.pause()
    return build_state(hosted)


@router.post("/{session}/quick-stop")
@allow(OBSERVER)
def quick_stop(hosted: NamedSession) -> SessionState:
    """Set zero current at once on a bench, latched until cleared; a simulation pauses.

    Software may fail to deliver it: this is not an emergency stop in the sense of EN ISO 13850.
    """
    hosted.session.quick_stop()
    return build_state(hosted)


@router.post("/{session}/reset")
@allow(OPERATOR)
def reset(hosted: NamedSession) -> SessionState:
    """Restart at t = 0 with the current settings, also after a fault."""
    hosted.session.reset()
    return build_state(hosted)


@router.post("/{session}/step")
@allow(OPERATOR)
def step(
    hosted: NamedSession, request: Annotated[StepRequest, Body(examples=[{"ticks": 1}])]
) -> SessionState:
    """Run a number of ticks while the session is paused."""
    hosted.session.step(request.ticks)
    return build_state(hosted)


@router.put("/{session}/speed")
@allow(OPERATOR)
def set_speed(
    hosted: NamedSession, request: Annotated[SpeedRequest, Body(examples=[{"speed": 0.5}])]
) -> SessionState:
    """Set the speed of session time: slow motion or fast forward."""
    hosted.session.set_speed(float("inf") if request.speed == "max" else request.speed)
    return build_state(hosted)


@router.post("/{session}/experiment")
@allow(OPERATOR)
async def load_experiment(
    request: Request,
    hosted: NamedSession,
    person: NamedPerson,
    experiment: Annotated[
        ExperimentRequest,
        Body(
            examples=[
                {"figure": "4a", "law": "ndobc", "load": True},
                {"from": "exercise", "exercise": "feedback-linearization", "step": "load"},
                {"from": "before_exercise"},
            ]
        ),
    ],
) -> SessionState:
    """Set a session to a figure or an exercise's experiment, or back to before the exercise."""
    if isinstance(experiment, ExerciseExperiment):
        await set_up_step(request, hosted, person, experiment.exercise, experiment.step)
        return build_state(hosted)
    if isinstance(experiment, SettingsBeforeExercise):
        await restore_settings(hosted)
        return build_state(hosted)
    session = hosted.session
    check_svsa(session)
    configuration = experiment.build_configuration(request.app.state.design)

    def begin() -> None:
        session.load(configuration)
        if experiment.start:
            session.start()
        else:
            session.pause()

    await run_waiting(begin)
    hosted.keep_before_exercise(None)
    return build_state(hosted)


@router.get(
    "/{session}/stream",
    tags=["stream"],
    status_code=426,
    operation_id="stream_session",
    summary="Stream Samples",
    response_model=Problem,
    response_description="This is a WebSocket",
    description=describe_stream(BATCH_PERIOD_S),
    responses={UPGRADED: {"model": StreamMessage, "description": "The text messages"}},
    openapi_extra={"parameters": list_stream_parameters()},
)
@allow(OBSERVER)
async def describe(_: NamedSession) -> JSONResponse:
    """The stream; a request without a WebSocket receives 426 with an explanation."""
    headers = {"Upgrade": "websocket", "Connection": "Upgrade"}
    return answer_problem(426, "websocket", "This is a WebSocket; see /docs.", headers)


@router.websocket("/{session}/stream")
@allow(OBSERVER)
async def stream(websocket: WebSocket, hosted: NamedSession, person: NamedPerson) -> None:
    """Stream the samples; see `stream_schemas` for the format."""
    await stream_session(websocket, hosted, person)

"""The loads of a session: list, add, read, remove."""

from typing import Annotated

from fastapi import Body, Query

from svsa.errors import StateError
from svsa.runs.definition.command import ApplyLoad, JointNumber, RemoveLoad
from svsa.runs.definition.configuration import MAX_JOINTS
from svsa.runs.session.session import remove_loads
from svsa.simulation.plant.loads import Load
from svsa.simulation.plant.loads.mass import PAPER_ARM_M, PAPER_MASS_KG
from svsa_server.access.permissions import OBSERVER, OPERATOR, allow
from svsa_server.problems import UnknownError
from svsa_server.routes.depends import CREATED, REFUSALS, Locate, NamedSession
from svsa_server.routing import build_router
from svsa_server.schemas.lab.session import AddedLoad, LoadState, SessionState
from svsa_server.sessions.state import build_state
from svsa_server.sessions.waiting import WaitingRoute

router = build_router(
    "/sessions/{session}/loads", tags=["loads"], responses=REFUSALS, route_class=WaitingRoute
)


GivenLoad = Annotated[
    Load,
    Body(
        examples=[
            {"kind": "paper"},
            {"kind": "mass", "mass_kg": PAPER_MASS_KG, "arm_m": PAPER_ARM_M},
            {"kind": "pulse", "torque_nm": [2.0, 0.0, 0.0], "duration_s": 0.5},
            {"kind": "push", "torque_nm": [1.0, 0.0, 0.0], "hold_s": 0.5},
            {"kind": "tip_mass", "mass_kg": 0.1},
            {"kind": "tip_push", "force_n": [1.0, 0.0], "hold_s": 0.5},
            {"kind": "sine", "torque_nm": [1.0, 0.0, 0.0], "frequency_hz": 1.0},
            {
                "kind": "series",
                "time_s": [0.0, 1.0, 2.0],
                "torque_nm": [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 0.0]],
            },
        ]
    ),
]


@router.get("")
@allow(OBSERVER)
def list_loads(hosted: NamedSession) -> list[LoadState]:
    """List the loads of a session, in the order in which they were added."""
    return build_state(hosted).loads


@router.post("", status_code=201, responses=CREATED)
@allow(OPERATOR)
def apply_load(
    hosted: NamedSession,
    locate: Locate,
    load: GivenLoad,
    joint: Annotated[
        JointNumber | None,
        Query(
            ge=1,
            le=MAX_JOINTS,
            description="Joint of an arm on which a torque acts; default: joint 1",
        ),
    ] = None,
) -> AddedLoad:
    """Add a load, now or at `start_s`; the answer has its `id`, and `Location` its address.

    A push ends automatically; if it is sent again while it is active, it is changed and extended as
    one load.
    """
    session = hosted.session
    if session.status == "fault":
        raise StateError(
            f"Session {session.name} is in a fault and takes no load: reset it, or clear the fault"
            " of a bench, and add the load then."
        )
    command = session.change(ApplyLoad(argument=load, joint=joint))
    # A push that is sent again is its active load, which has the new value and may not be the last.
    added = next(held for held in reversed(build_state(hosted).loads) if held.load == load)
    locate(f"/sessions/{session.name}/loads/{added.id}")
    time_s = command.tick * session.run.period_s
    return AddedLoad(**dict(added), tick=command.tick, time_s=time_s)


@router.get("/{load_id}")
@allow(OBSERVER)
def read_load(hosted: NamedSession, load_id: int) -> LoadState:
    """Read a load of a session."""
    matches = [load for load in build_state(hosted).loads if load.id == load_id]
    if not matches:
        raise _refuse(load_id)
    return matches[0]


@router.delete("")
@allow(OPERATOR)
def clear_loads(hosted: NamedSession) -> SessionState:
    """Remove all loads from a session."""
    remove_loads(hosted.session)
    return build_state(hosted)


@router.delete("/{load_id}")
@allow(OPERATOR)
def remove_load(hosted: NamedSession, load_id: int) -> SessionState:
    """Remove a load from a session."""
    if load_id not in (load.number for load in hosted.session.run.loads):
        raise _refuse(load_id)
    hosted.session.change(RemoveLoad(argument=load_id))
    return build_state(hosted)


def _refuse(load_id: int) -> UnknownError:
    return UnknownError(f"There is no load {load_id} in this session.")

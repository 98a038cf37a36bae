"""Apply loads and take them off."""

from typing import Annotated

from fastapi import Body

from svsa.runs.command import ApplyLoad, RemoveLoad
from svsa.runs.session.session import take_loads_off
from svsa.simulation.plant.loads import Load
from svsa.simulation.plant.loads.mass import PAPER_ARM_M, PAPER_MASS_KG
from svsa_server.access.permissions import OPERATOR, allow
from svsa_server.problems import UnknownError
from svsa_server.routes.depends import REFUSALS, NamedSession
from svsa_server.routing import build_router
from svsa_server.schemas.lab.session import SessionState
from svsa_server.sessions.lock import TurnRoute
from svsa_server.sessions.state import build_state

router = build_router(
    "/sessions/{session}/loads", tags=["loads"], responses=REFUSALS, route_class=TurnRoute
)


GivenLoad = Annotated[
    Load,
    Body(
        examples=[
            {"kind": "paper"},
            {"kind": "mass", "mass_kg": PAPER_MASS_KG, "arm_m": PAPER_ARM_M},
            {"kind": "pulse", "torque_nm": [2.0, 0.0, 0.0], "duration_s": 0.5},
            {"kind": "push", "torque_nm": [1.0, 0.0, 0.0], "hold_s": 0.5},
            {"kind": "sine", "torque_nm": [1.0, 0.0, 0.0], "frequency_hz": 1.0},
            {
                "kind": "series",
                "time_s": [0.0, 1.0, 2.0],
                "torque_nm": [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 0.0]],
            },
        ]
    ),
]


@router.post("", status_code=201)
@allow(OPERATOR)
def apply_load(
    hosted: NamedSession,
    load: GivenLoad,
) -> SessionState:
    """Apply a load, now or at `start_s`; it is the last of `loads` in the answer.

    A push ends automatically: sent again while it is on, it is changed and lasts on, as one load.
    """
    hosted.session.change(ApplyLoad(argument=load))
    return build_state(hosted)


@router.delete("")
@allow(OPERATOR)
def clear_loads(hosted: NamedSession) -> SessionState:
    """Take every load off."""
    take_loads_off(hosted.session)
    return build_state(hosted)


@router.delete("/{load_id}")
@allow(OPERATOR)
def remove_load(hosted: NamedSession, load_id: int) -> SessionState:
    """Take one load off."""
    if load_id not in (load.number for load in hosted.session.run.loads):
        raise UnknownError(f"There is no load {load_id} in this session.")
    hosted.session.change(RemoveLoad(argument=load_id))
    return build_state(hosted)

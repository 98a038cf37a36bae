"""The arms of the lab, and the arm of a session."""

from typing import Annotated

from fastapi import Body, Depends

from svsa.errors import StateError
from svsa.runs.definition.arm_experiment import ARMS
from svsa.runs.definition.command import Set
from svsa_server.access.permissions import OBSERVER, OPERATOR, allow
from svsa_server.routes.depends import CHANGED, REFUSALS, NamedSession, check_unchanged
from svsa_server.routing import build_router
from svsa_server.schemas.lab.arm import AT_ONCE, ArmPatch, NamedArmState
from svsa_server.schemas.lab.session import SessionState
from svsa_server.sessions.state import build_state
from svsa_server.sessions.waiting import WaitingRoute

router = build_router("", tags=["lab"], responses=REFUSALS | CHANGED, route_class=WaitingRoute)


@router.get("/arms")
@allow(OBSERVER)
async def read_arms() -> list[NamedArmState]:
    """List the arms that a session can simulate."""
    return [NamedArmState(name=name, **arm._asdict()) for name, arm in ARMS.items()]


@router.patch("/sessions/{session}/arm", dependencies=[Depends(check_unchanged)])
@allow(OPERATOR)
def change_arm(
    hosted: NamedSession,
    patch: Annotated[
        ArmPatch,
        Body(
            examples=[
                {"feedforward": True},
                {"adaptation": {"mass_max_kg": 1.0}},
                {
                    "tip": {
                        "kind": "ellipse",
                        "center_m": [0.25, -0.35],
                        "radii_m": [0.1, 0.05],
                        "frequency_hz": 0.25,
                    }
                },
            ]
        ),
    ],
) -> SessionState:
    """Change the arm of a session.

    Feedforward and adaptation act at once. A reference of the tip, and links, restart the run at
    t = 0 with the current settings.
    """
    session = hosted.session
    configuration = session.run.configuration
    if configuration.arm is None:
        raise StateError(
            f"Session {session.name} is of a single joint: open an arm with POST /sessions"
            ' {"from": "arm"}.'
        )
    changed = configuration.changed(arm=patch.apply_to(configuration.arm))
    fields = patch.list_given()
    if set(fields) <= set(AT_ONCE):
        for kind, value in fields.items():
            session.set(Set(kind, value))
    elif changed != configuration:
        session.load(changed.with_loads_of(session.journal.initial))
    return build_state(hosted)

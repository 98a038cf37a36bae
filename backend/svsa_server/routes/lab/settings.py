"""Change the settings of a session: references, law, lanes, plant and effects.

Setting the current value again changes nothing: no transition, no event, no new window.
"""

from typing import TYPE_CHECKING, Annotated, Any

from fastapi import Body, Depends, Path, Query

from svsa.actuators.parameters import MechanismParameters
from svsa.control.installed import check_installed, read_parameters
from svsa.control.observers.disturbance import ObserverBandwidth
from svsa.control.observers.spring import SpringEstimation
from svsa.control.parameters import LawParameters
from svsa.errors import ParameterError
from svsa.inputs.checked import Checked
from svsa.runs.definition.command import JointNumber, Set
from svsa.runs.definition.configuration import MAX_JOINTS
from svsa.runs.definition.design import LaneSetting
from svsa.simulation.plant.effects import Effects
from svsa.simulation.reference.kinds import PositionReference, StiffnessReference
from svsa_server.access.permissions import OBSERVER, OPERATOR, allow
from svsa_server.routes.depends import CHANGED, REFUSALS, NamedSession, check_unchanged
from svsa_server.routing import build_router
from svsa_server.schemas.lab.gain import GainsRequest
from svsa_server.schemas.lab.law import InstalledLane
from svsa_server.schemas.lab.session import SessionState
from svsa_server.schemas.lab.setting import (
    ConfigurationState,
    LanesRequest,
    LawRequest,
    build_patch,
)
from svsa_server.sessions.state import build_state
from svsa_server.sessions.waiting import WaitingRoute

router = build_router(
    "/sessions/{session}",
    tags=["settings"],
    responses=REFUSALS | CHANGED,
    route_class=WaitingRoute,
    dependencies=[Depends(check_unchanged)],
)

Restart = Annotated[
    bool,
    Query(description="Restart the reference with a fade, even if it is already followed"),
]

OfJoint = Annotated[
    JointNumber | None,
    Query(ge=1, le=MAX_JOINTS, description="Joint of an arm to change; default: all"),
]

if TYPE_CHECKING:
    ActuatorPatch = Checked
    NominalPatch = Checked
else:
    ActuatorPatch = build_patch("actuator")
    NominalPatch = build_patch("nominal")


@router.get("/settings")
@allow(OBSERVER)
def read_settings(hosted: NamedSession) -> ConfigurationState:
    """Read the settings of a session: references, law, gains, observer, lanes, plant, effects."""
    return build_state(hosted).configuration


@router.put("/position")
@allow(OPERATOR)
def set_position(
    hosted: NamedSession,
    reference: Annotated[
        PositionReference,
        Body(
            examples=[
                {"kind": "sine", "amplitude_rad": 1.0472, "frequency_hz": 0.2},
                {"kind": "constant", "position_rad": 0.5, "transition_s": 2.0},
            ]
        ),
    ],
    restart: Restart = False,
    joint: OfJoint = None,
) -> SessionState:
    """Set the position reference, faded over without a jump in any derivative."""
    hosted.session.patch(lambda _: Set("position", reference), joint, again=restart)
    return build_state(hosted)


@router.put("/stiffness")
@allow(OPERATOR)
def set_stiffness(
    hosted: NamedSession,
    reference: Annotated[
        StiffnessReference,
        Body(
            examples=[
                {"kind": "constant", "stiffness_nm_per_rad": 60.0},
                {
                    "kind": "sine",
                    "offset_nm_per_rad": 35.0,
                    "amplitude_nm_per_rad": 1.0,
                    "frequency_hz": 0.2,
                },
            ]
        ),
    ],
    restart: Restart = False,
    joint: OfJoint = None,
) -> SessionState:
    """Set the stiffness reference, inside the limits of the session's actuator."""
    hosted.session.patch(lambda _: Set("stiffness", reference), joint, again=restart)
    return build_state(hosted)


@router.put("/law")
@allow(OPERATOR)
def set_law(
    hosted: NamedSession,
    request: Annotated[
        LawRequest, Body(examples=[{"law": "fl"}, {"law": "fl", "comparison_laws": ["ndobc"]}])
    ],
    joint: OfJoint = None,
) -> SessionState:
    """Change the law of lane 1, and of the comparison lanes; every plant keeps its state."""
    command = Set("law", request.law)
    if request.comparison_laws:
        command = Set("laws", (request.law, *request.comparison_laws))
    hosted.session.patch(lambda _: command, joint)
    return build_state(hosted)


@router.put("/gains")
@allow(OPERATOR)
def set_gains(
    hosted: NamedSession,
    request: Annotated[
        GainsRequest,
        Body(
            examples=[
                {"position_poles_rad_per_s": [-60, -60, [-40, 30], [-40, -30]]},
                {"stiffness_coefficients": [1600.0, 80.0]},
            ]
        ),
    ],
    joint: OfJoint = None,
) -> SessionState:
    """Set the gains, as poles or coefficients; rejected with the roots if not Hurwitz."""
    hosted.session.patch(lambda run: Set("gains", request.apply_to(run.gains)), joint)
    return build_state(hosted)


@router.put("/parameters")
@allow(OPERATOR)
def set_parameters(
    hosted: NamedSession,
    request: Annotated[
        dict[str, dict[str, Any]],
        Body(examples=[{"fl_integral": {"position_pole_rad_per_s": 54.6}}]),
    ],
    joint: OfJoint = None,
) -> SessionState:
    """Set parameters of laws that have their own, by the name of the law (see `GET /laws`).

    Omitted parameters keep their values.
    """
    hosted.session.patch(lambda run: Set("parameters", _merge(run.parameters, request)), joint)
    return build_state(hosted)


@router.put("/observer")
@allow(OPERATOR)
def set_observer(
    hosted: NamedSession,
    request: Annotated[
        ObserverBandwidth, Body(examples=[{"bandwidth_rad_per_s": [80.0, 80.0, 80.0]}])
    ],
    joint: OfJoint = None,
) -> SessionState:
    """Set the bandwidth of the disturbance observer on link, motor 1 and motor 2."""
    hosted.session.patch(lambda _: Set("observer", request), joint)
    return build_state(hosted)


@router.put("/spring")
@allow(OPERATOR)
def set_spring(
    hosted: NamedSession,
    request: Annotated[SpringEstimation, Body(examples=[{}, {"is_on": False}])],
    joint: OfJoint = None,
) -> SessionState:
    """Set the spring estimator, which starts again from its prior; omitted fields are defaults."""
    hosted.session.patch(lambda _: Set("spring", request), joint)
    return build_state(hosted)


@router.patch("/actuator")
@allow(OPERATOR)
def change_actuator(
    hosted: NamedSession,
    patch: Annotated[ActuatorPatch, Body(examples=[{"link_inertia_kg_m2": 0.0206}])],
    joint: OfJoint = None,
) -> SessionState:
    """Change parameters of the true plant."""
    hosted.session.patch(
        lambda run: Set("actuator", _apply(patch, "actuator", run.actuator)), joint
    )
    return build_state(hosted)


@router.patch("/nominal")
@allow(OPERATOR)
def change_nominal(
    hosted: NamedSession,
    patch: Annotated[NominalPatch, Body(examples=[{"link_inertia_kg_m2": 0.0103}])],
    joint: OfJoint = None,
) -> SessionState:
    """Change parameters of the nominal model of controller and observer."""
    hosted.session.patch(lambda run: Set("nominal", _apply(patch, "nominal", run.nominal)), joint)
    return build_state(hosted)


@router.put("/effects")
@allow(OPERATOR)
def set_effects(
    hosted: NamedSession,
    effects: Annotated[
        Effects,
        Body(examples=[{"encoders": {}, "estimation": {}, "delay_samples": 1}, {}]),
    ],
    joint: OfJoint = None,
) -> SessionState:
    """Set the non-ideal effects of the simulation; omitted effects are off."""
    hosted.session.patch(lambda _: Set("effects", effects), joint)
    return build_state(hosted)


@router.put("/lanes")
@allow(OPERATOR)
def set_lanes(
    hosted: NamedSession,
    request: Annotated[
        LanesRequest, Body(examples=[{"comparisons": [{"law": "fl"}]}, {"comparisons": []}])
    ],
) -> SessionState:
    """Set the comparison lanes: other controllers with the same references, loads and noise."""
    hosted.session.set(Set("comparisons", request.comparisons))
    return build_state(hosted)


@router.put("/lanes/{lane}")
@allow(OPERATOR)
def set_lane(
    hosted: NamedSession,
    lane: Annotated[int, Path(description="Number of a comparison lane, from 2", examples=[2])],
    request: Annotated[
        InstalledLane,
        Body(
            examples=[
                {"law": "fl_integral", "parameters": {"position_pole_rad_per_s": 40.0}},
                {"law": "fl"},
            ]
        ),
    ],
    joint: OfJoint = None,
) -> SessionState:
    """Change the controller of one comparison lane; its plant keeps its state.

    Omitted settings are those of the session. The same law keeps its memory.
    """
    setting = LaneSetting(lane=lane, setting=request)
    hosted.session.patch(lambda _: Set("lane", setting), joint)
    return build_state(hosted)


def _apply(patch: Checked, section: str, actuator: MechanismParameters) -> MechanismParameters:
    try:
        return actuator.changed(**patch.model_dump(exclude_unset=True))
    except ParameterError as error:
        raise error.within(section) from None


def _merge(
    held: dict[str, LawParameters], changes: dict[str, dict[str, Any]]
) -> dict[str, LawParameters]:
    """Return the current parameters of the laws, with these changes, by law."""
    changed = dict(held)
    for law, values in changes.items():
        try:
            check_installed(law)
        except ParameterError as error:
            raise error.within("law") from None
        kept = held[law].model_dump() if law in held else {}
        try:
            changed[law] = read_parameters(law, kept | values)
        except ParameterError as error:
            raise error.within(law) from None
    return changed

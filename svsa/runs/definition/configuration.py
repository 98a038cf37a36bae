"""The configuration of a run: design, laws, references, loads and arm."""

from collections.abc import Mapping, Sequence
from typing import Any, Self

from pydantic import model_validator

from svsa.actuators.arm.parameters import MAX_LINKS, ArmParameters
from svsa.actuators.reach import check_only_stiffness
from svsa.control.arm_payload import PayloadAdaptation
from svsa.control.installed import (
    PAPERS_LAW,
    LawName,
    get_law,
    has_own_parameters,
    is_usable,
)
from svsa.control.observers.spring import SpringEstimation
from svsa.control.parameters import LawParameters
from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import Checked, Flag, Whole, quantity
from svsa.runs.definition.design import MAX_LANES, Design, Lane
from svsa.simulation.arm.tip_reference import TipReference
from svsa.simulation.plant.effects import IDEAL, Effects
from svsa.simulation.plant.loads import Load
from svsa.simulation.plant.loads.load import MASS, TIP
from svsa.simulation.reference.kinds import PositionReference, StiffnessReference, get_range

MAX_LOADS = 16
MAX_JOINTS = MAX_LINKS


class ArmSetup(Checked):
    """The arm whose joint 1 the rest of the configuration describes: links and the other joints.

    Each joint has its own actuator, nominal model, law, gains, observer, limits, effects,
    references and torques. The arm's M(q) replaces the link inertia of its plant; its nominal link
    inertia is what its law knows of the arm. Loads at the tip are those of joint 1.
    """

    links: ArmParameters = quantity("", "The links")
    model: ArmParameters = quantity("", "The links in the model of the feedforward")
    feedforward: Flag = quantity("", "Whether the laws receive the arm feedforward", default=False)
    adaptation: PayloadAdaptation | None = quantity(
        "", "Estimate of the mass at the tip, for feedforward and nominal inertias", default=None
    )
    tip: TipReference | None = quantity(
        "", "Reference of the tip, in place of the joints' position references", default=None
    )
    other_joints: "tuple[Configuration, ...]" = quantity(
        "", "The joints from the second on", max_length=MAX_JOINTS - 1
    )


class Configuration(Design):
    """Everything that determines a run, except the commands during it."""

    law: LawName = quantity("", "Name of an installed law", default=PAPERS_LAW)
    comparisons: tuple[Lane, ...] = quantity(
        "",
        "Controllers of the comparison lanes, each with its own plant",
        default=(),
        max_length=MAX_LANES - 1,
    )
    effects: Effects = quantity(
        "", "Non-ideal effects of the simulation", symbol="Effects", default=IDEAL
    )
    seed: Whole = quantity("", "Seed of the sensor noise", ge=0, le=2**63 - 1, default=0)
    spring: SpringEstimation = quantity(
        "", "Spring estimator, which measures the stiffness", default=SpringEstimation(is_on=False)
    )
    position: PositionReference
    stiffness: StiffnessReference
    loads: tuple[Load, ...] = quantity(
        "", "Loads from the start on", default=(), max_length=MAX_LOADS
    )
    arm: ArmSetup | None = quantity(
        "", "The arm of which this is joint 1; None for a single joint", default=None
    )

    @model_validator(mode="after")
    def _check_stiffness_range(self) -> Self:
        low, high = get_range(self.stiffness)
        check_only_stiffness(self.nominal, low, high)
        self.limits.check_stiffness("stiffness", low, high)
        return self

    @model_validator(mode="after")
    def _check_arm(self) -> Self:
        arm = self.arm
        if arm is None:
            if any(load.acts_as == TIP for load in self.loads):
                bound = "loads on a joint; those at the tip are tip_loads of svsa.simulate_arm"
                raise ParameterError(Violation("loads", "at the tip", "", bound))
            return self
        if arm.tip is not None and len(self.joints) != 2:
            bound = "None: inverse kinematics of the tip is that of an arm of two links"
            raise ParameterError(Violation("arm.tip", arm.tip.kind, "", bound))
        if arm.tip is not None:
            arm.tip.check_reach(arm.links)
        joints = len(self.joints)
        for name, links in (("arm.links", arm.links), ("arm.model", arm.model)):
            if len(links.chain) != joints:
                bound = f"{joints} links, one for each joint"
                raise ParameterError(Violation(f"{name}.chain", len(links.chain), "", bound))
        if wrong := _list_wrong(self, arm):
            raise ParameterError(*wrong)
        for number, joint in enumerate(arm.other_joints, start=2):
            if wrong := [*_list_wrong(joint, arm), *_list_unequal(joint, self)]:
                raise ParameterError(*wrong).within(f"joint{number}")
        pushed = [number for number, joint in enumerate(self.joints, start=1) if _has_push(joint)]
        if len(pushed) > 1:
            bound = f"loads without a push at t = 0: one acts on joint {pushed[0]} already"
            raise ParameterError(Violation(f"joint{pushed[1]}.loads", "push", "", bound))
        return self

    @property
    def joints(self) -> "tuple[Configuration, ...]":
        """The configuration of each joint: itself, and the other joints of an arm."""
        return (self,) if self.arm is None else (self, *self.arm.other_joints)

    def change_joints(self, changes: Sequence[Mapping[str, Any]]) -> Self:
        """Return the configuration with changed fields of each joint, which are changed together.

        Args:
            changes: New values by name of the field, for each joint.

        Returns:
            The changed configuration.

        Raises:
            ParameterError: If a value is invalid.
        """
        own, *others = changes
        if self.arm is None:
            return self.changed(**own)
        pairs = zip(self.arm.other_joints, others, strict=True)
        joints = tuple(joint.changed(**fields) for joint, fields in pairs)
        return self.changed(**own, arm=self.arm.changed(other_joints=joints))

    @property
    def controllers(self) -> tuple[Lane, ...]:
        """The own controller of this joint, and its comparisons."""
        return (Lane(law=self.law), *self.comparisons)

    @property
    def lanes(self) -> tuple[Lane, ...]:
        """All lanes: each controller, for an arm that of joint 1, then those of the others."""
        controllers = zip(*(joint.controllers for joint in self.joints), strict=True)
        return tuple(lane for lanes in controllers for lane in lanes)

    @property
    def planned_loads(self) -> tuple[Load, ...]:
        """The loads from the start on, of every joint."""
        return tuple(load for joint in self.joints for load in joint.loads)

    def require_arm(self) -> ArmSetup:
        """Return the arm.

        Returns:
            Links, the other joints, and what acts on all joints.

        Raises:
            ParameterError: If the run is one of a single joint.
        """
        if self.arm is None:
            raise ParameterError(Violation("arm", None, "", "an arm: this is a single joint"))
        return self.arm

    def with_loads_of(self, other: Self) -> Self:
        """Return the configuration with the planned loads of another one, joint by joint.

        Args:
            other: Configuration of the loads, with as many joints.

        Returns:
            The changed configuration.
        """
        return self.change_joints([{"loads": joint.loads} for joint in other.joints])

    def list_parameters(self) -> dict[str, LawParameters]:
        """List the parameters that were set, and those of the lanes' laws.

        Returns:
            The parameters by law.
        """
        laws = dict.fromkeys((*(lane.law for lane in self.controllers), *self.parameters))
        own = (law for law in laws if is_usable(law) and has_own_parameters(law))
        return {law: self.get_parameters(Lane(law=law)) for law in own}

    def with_design(self, design: Design) -> Self:
        """Return the configuration with another design; unnamed laws keep their parameters.

        Args:
            design: Gains, observer, limits, models and parameters.

        Returns:
            The changed configuration.
        """
        parameters = {**self.parameters, **design.parameters}
        return self.changed(**(dict(design) | {"parameters": parameters}))


def _has_push(joint: Configuration) -> bool:
    """Whether a push on the joint begins at t = 0. A run has at most one push on its joints."""
    on_joint = (load for load in joint.loads if load.acts_as != TIP)
    return any(load.is_push and load.start_s is None for load in on_joint)


def _list_unequal(joint: Configuration, first: Configuration) -> list[Violation]:
    """List what another joint of an arm cannot have next to joint 1."""
    violations: list[Violation] = []
    if joint.arm is not None:
        bound = "None: the joints of an arm have no arm of their own"
        violations.append(Violation("arm", "an arm", "", bound))
    for load in joint.loads:
        if load.acts_as == TIP:
            bound = "torques; a load at the tip is a load of joint 1"
            violations.append(Violation("loads", load.kind, "", bound))
    if joint.sampling != first.sampling:
        bound = f"{first.sampling.period_s:g} s, as that of joint 1"
        violations.append(Violation("sampling.period_s", joint.sampling.period_s, "s", bound))
    if len(joint.comparisons) != len(first.comparisons):
        bound = f"{len(first.comparisons)}, as for joint 1"
        violations.append(Violation("comparisons", len(joint.comparisons), "", bound))
    return violations


def _list_wrong(joint: Configuration, arm: ArmSetup) -> list[Violation]:
    """List what a joint of an arm cannot have."""
    violations: list[Violation] = []
    joints = 1 + len(arm.other_joints)
    if (1 + len(joint.comparisons)) * joints > MAX_LANES:
        bound = f"at most {MAX_LANES // joints - 1} comparison of an arm of {joints} joints"
        violations.append(Violation("comparisons", len(joint.comparisons), "", bound))
    if joint.effects.gravity is not None:
        bound = "None: the weight of the links is in the parameters of the arm"
        violations.append(Violation("effects.gravity", joint.effects.gravity, "", bound))
    for load in joint.loads:
        if load.acts_as == MASS:
            bound = "torques; a mass hangs at the tip (tip_mass), which is a load of joint 1"
            violations.append(Violation("loads", load.kind, "", bound))
    for lane in joint.controllers if arm.feedforward else ():
        if is_usable(lane.law) and not get_law(lane.law).takes_feedforward:
            bound = (
                "a law that takes the arm feedforward: this one estimates the complete"
                " disturbance, so the feedforward would count twice, or it does not use q̈_d"
            )
            violations.append(Violation("law", lane.law, "", bound))
    return violations


ArmSetup.model_rebuild()

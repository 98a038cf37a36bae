"""The configuration of a run: parameters, design, references, loads and arm."""

from typing import Any, Self

from pydantic import ValidationInfo, field_validator, model_validator

from svsa.actuators.arm.parameters import ArmParameters
from svsa.actuators.installed import InstalledActuator
from svsa.actuators.parameters import Limits, get_mechanism_name
from svsa.actuators.reach import check_only_stiffness
from svsa.control.arm_payload import PayloadAdaptation
from svsa.control.gains import Gains
from svsa.control.installed import (
    PAPERS_LAW,
    LaneParameters,
    LawName,
    ParametersByLaw,
    get_law,
    has_own_parameters,
    is_usable,
    read_parameters,
)
from svsa.control.observers.disturbance import ObserverBandwidth
from svsa.control.parameters import LawParameters
from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import Checked, Flag, Number, Whole, quantity
from svsa.simulation.arm.tip_reference import TipReference
from svsa.simulation.plant.effects import IDEAL, Effects
from svsa.simulation.plant.loads import Load
from svsa.simulation.plant.loads.load import MASS, TIP
from svsa.simulation.reference.kinds import PositionReference, StiffnessReference, get_range

MAX_LOADS = 16
MAX_LANES = 4


class Sampling(Checked):
    """The sampling of the loop."""

    period_s: Number = quantity("s", "Control period T, zero-order hold", ge=1e-4, le=0.02)


class Design(Checked):
    """The content of a parameter file: plant, nominal model, gains, laws, observer, limits,
    sampling.
    """

    actuator: InstalledActuator
    nominal: InstalledActuator
    gains: Gains
    parameters: ParametersByLaw = quantity(
        "",
        "Parameters of laws that have their own, by the law's name; else its defaults",
        default={},
    )
    observer: ObserverBandwidth
    limits: Limits
    sampling: Sampling

    @model_validator(mode="after")
    def _check_mechanism(self) -> Self:
        of_plant, of_model = map(get_mechanism_name, (self.actuator, self.nominal))
        if of_plant != of_model:
            bound = f"{of_plant}, as that of the actuator"
            raise ParameterError(Violation("nominal.mechanism", of_model, "", bound))
        return self

    def find_parameters(self, lane: "Lane") -> LawParameters | None:
        """Return the parameters that were set for a lane's law.

        Args:
            lane: A lane of a run with this design.

        Returns:
            The lane's parameters, otherwise those of the design, otherwise None.
        """
        if has_own_parameters(lane.law):
            return lane.parameters or self.parameters.get(lane.law)
        return lane.gains or self.gains

    def get_parameters(self, lane: "Lane") -> LawParameters:
        """Return the parameters of a lane's law: the lane's, the design's, or the defaults.

        Args:
            lane: A lane of a run with this design.

        Returns:
            The parameters.

        Raises:
            ParameterError: If the law is not installed and no parameters are set.
        """
        parameters = self.find_parameters(lane)
        return get_law(lane.law).parameters() if parameters is None else parameters


class Lane(Checked):
    """A controller with its own plant: same references, loads and noise as the others."""

    law: LawName = quantity("", "Name of an installed law")
    gains: Gains | None = quantity(
        "", "Gains of a law that uses them (FL, NDOBC); by default those of the run", default=None
    )
    parameters: LaneParameters = quantity(
        "", "Parameters of a law that has its own; by default those of the run", default=None
    )
    observer: ObserverBandwidth | None = quantity(
        "", "Observer bandwidth; by default that of the run", default=None
    )

    @field_validator("parameters")
    @classmethod
    def _read_parameters(cls, parameters: Any, info: ValidationInfo) -> LawParameters | None:
        law = info.data.get("law")
        return parameters if parameters is None or law is None else read_parameters(law, parameters)

    def controlled_by(self, law: str) -> Self:
        """Return the lane with another law: gains and observer are kept, parameters are not.

        Args:
            law: Name of the law.

        Returns:
            The lane; itself if it already has this law.
        """
        return self if law == self.law else self.changed(law=law, parameters=None)


class LaneSetting(Checked):
    """The controller of a comparison lane."""

    lane: Whole = quantity("", "Number of the lane; 1 is the run's own", ge=2, le=MAX_LANES)
    setting: Lane


class ArmSetup(Checked):
    """The arm whose joint 1 the rest of the configuration describes: links and joint 2.

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
    joint2: "Configuration"


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
        if arm.tip is not None:
            arm.tip.check_reach(arm.links)
        second = arm.joint2
        for name, joint in (("", self), ("arm.joint2", second)):
            if wrong := _list_wrong(joint, arm, is_second=joint is second):
                error = ParameterError(*wrong)
                raise error.within(name) if name else error
        if all(map(_has_push, (self, second))):
            bound = "loads without a push at t = 0: one acts on joint 1 already"
            raise ParameterError(Violation("arm.joint2.loads", "push", "", bound))
        if second.sampling != self.sampling:
            bound = f"{self.sampling.period_s:g} s, as that of joint 1"
            value = second.sampling.period_s
            raise ParameterError(Violation("arm.joint2.sampling.period_s", value, "s", bound))
        if len(second.comparisons) != len(self.comparisons):
            bound = f"{len(self.comparisons)}, as for joint 1"
            value = len(second.comparisons)
            raise ParameterError(Violation("arm.joint2.comparisons", value, "", bound))
        return self

    @property
    def joints(self) -> "tuple[Configuration, ...]":
        """The configuration of each joint: itself, and joint 2 of an arm."""
        return (self,) if self.arm is None else (self, self.arm.joint2)

    @property
    def controllers(self) -> tuple[Lane, ...]:
        """The own controller of this joint, and its comparisons."""
        return (Lane(law=self.law), *self.comparisons)

    @property
    def lanes(self) -> tuple[Lane, ...]:
        """All lanes: each controller, for an arm that of joint 1, then that of joint 2."""
        controllers = zip(*(joint.controllers for joint in self.joints), strict=True)
        return tuple(lane for lanes in controllers for lane in lanes)

    @property
    def planned_loads(self) -> tuple[Load, ...]:
        """The loads from the start on, of every joint."""
        return tuple(load for joint in self.joints for load in joint.loads)

    def require_arm(self) -> ArmSetup:
        """Return the arm.

        Returns:
            Links, joint 2, and what acts on both joints.

        Raises:
            ParameterError: If the run is one of a single joint.
        """
        if self.arm is None:
            raise ParameterError(Violation("arm", None, "", "an arm: this is a single joint"))
        return self.arm

    def with_loads_of(self, other: Self) -> Self:
        """Return the configuration with the planned loads of another one, joint by joint.

        Args:
            other: Configuration of the loads, of an arm if this is one.

        Returns:
            The changed configuration.
        """
        if self.arm is None or other.arm is None:
            return self.changed(loads=other.loads)
        second = self.arm.joint2.changed(loads=other.arm.joint2.loads)
        return self.changed(loads=other.loads, arm=self.arm.changed(joint2=second))

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


def _list_wrong(joint: Configuration, arm: ArmSetup, is_second: bool) -> list[Violation]:
    """List what a joint of an arm cannot have."""
    violations: list[Violation] = []
    if is_second and joint.arm is not None:
        violations.append(Violation("arm", "an arm", "", "None: an arm has two joints"))
    if len(joint.comparisons) > MAX_LANES // 2 - 1:
        bound = f"at most {MAX_LANES // 2 - 1} comparison of an arm"
        violations.append(Violation("comparisons", len(joint.comparisons), "", bound))
    if joint.effects.gravity is not None:
        bound = "None: the weight of the links is in the parameters of the arm"
        violations.append(Violation("effects.gravity", joint.effects.gravity, "", bound))
    for load in joint.loads:
        if load.acts_as == MASS or (is_second and load.acts_as == TIP):
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

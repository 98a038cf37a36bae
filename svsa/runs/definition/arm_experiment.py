"""The experiments of an arm, and their settings."""

from collections.abc import Mapping, Sequence
from itertools import cycle, zip_longest
from typing import Any, NamedTuple

from svsa.actuators.arm.parameters import FOUR_RODS, MACCEPA_ARM, RODS, ArmParameters
from svsa.actuators.parameters import INERTIAS_KG_M2
from svsa.control.installed import PAPERS_LAW
from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import check_number
from svsa.runs.definition.configuration import ArmSetup, Configuration
from svsa.runs.definition.experiment import build_actuator_experiment
from svsa.runs.definition.shorthand import change_configuration, read_loads
from svsa.simulation.arm.tip_reference import TipReference
from svsa.simulation.plant.loads import Load
from svsa.simulation.plant.loads.load import TIP
from svsa.simulation.reference.kinds.reference import AnyPosition
from svsa.simulation.reference.kinds.sine import SinePosition


def compute_joint_inertias(arm: ArmParameters) -> tuple[float, ...]:
    """Constant link inertias for the nominal models: Σ_{i≥j} a_ii of each joint j, kg·m².

    That is the diagonal of M(q) averaged over all angles; for two links its value at q2 = ±90°.
    """
    own = [row[number] for number, row in enumerate(arm.build().inertia)]
    return tuple(sum(own[number:]) for number in range(len(own)))


_SINES = (
    SinePosition(amplitude_rad=0.6, frequency_hz=0.25),
    SinePosition(amplitude_rad=0.8, frequency_hz=0.25, phase_rad=0.7),
)
_GENTLE = (
    SinePosition(amplitude_rad=0.2, frequency_hz=0.25),
    SinePosition(amplitude_rad=0.4, frequency_hz=0.25, phase_rad=0.7),
)


class NamedArm(NamedTuple):
    """An arm of the lab.

    Attributes:
        title: Its name on the page.
        description: What it is, in a sentence.
        links: Parameters of its links.
        actuator: Name of the actuator of its joints.
        stiffness_nm_per_rad: Default stiffness of its joints.
        motions: Default reference of the joints, in turns.
    """

    title: str
    description: str
    links: ArmParameters
    actuator: str
    stiffness_nm_per_rad: float
    motions: tuple[SinePosition, ...]

    def build_links(self, count: int) -> ArmParameters:
        """Return its first links.

        Args:
            count: Number of links.

        Raises:
            ParameterError: If it has fewer.
        """
        chain = self.links.chain
        if not 1 <= count <= len(chain):
            bound = f"1 to {len(chain)}, one for each link of this arm"
            raise ParameterError(Violation("actuators", count, "", bound))
        return self.links.changed(chain=chain[:count])


ARMS: Mapping[str, NamedArm] = {
    "rods": NamedArm(
        "Two rods",
        "Two rods of 0.3 m and 0.3 kg, hanging, with the SVSA in both joints.",
        RODS,
        "svsa",
        80.0,
        _SINES,
    ),
    "maccepa": NamedArm(
        "MACCEPA arm",
        "A two-link arm of the literature with MACCEPA in both joints.",
        MACCEPA_ARM,
        "maccepa",
        2.5,
        _GENTLE,
    ),
    "chain": NamedArm(
        "Four rods",
        "Four rods of 0.2 m and 0.3 kg, hanging, with the SVSA in every joint.",
        FOUR_RODS,
        "svsa",
        120.0,
        (SinePosition(amplitude_rad=0.2, frequency_hz=0.25),),
    ),
}
"""The arms by name."""


def build_arm_experiment(
    experiment: str | Configuration,
    fields: Mapping[str, Any],
    all_joints: Mapping[str, Any],
    each: Sequence[Mapping[str, Any]] = (),
    tip_loads: Load | Sequence[Load] | None = None,
) -> Configuration:
    """Build the configuration of an arm's experiment.

    Args:
        experiment: Name of an arm ("rods", "maccepa"), or the configuration of an arm.
        fields: Fields of `ArmSetup` to replace.
        all_joints: Settings of all joints, as `svsa.runs.definition.shorthand.Settings` and `law`.
        each: Settings of each joint, from joint 1 on, after those of all.
        tip_loads: Loads at the tip; None: those of the experiment.

    Returns:
        The configuration. Without a nominal link inertia in the settings, a named arm has that of
        `compute_joint_inertias`.

    Raises:
        ParameterError: There is no such arm or setting, or a value is out of range. Loads on a
            joint are not among `tip_loads`, and position references not next to one of the tip.
    """
    first = experiment
    if not isinstance(first, Configuration):
        first = _build_named(first, fields.get("links"))
    arm = first.require_arm()
    joints, separate = [], split_joints(first)
    for number, own in enumerate(each, start=1):
        if not isinstance(own, Mapping) or not all(isinstance(name, str) for name in own):
            bound = 'a dict of settings by name, such as {"stiffness": 40}'
            raise ParameterError(Violation(f"joint{number}", own, "", bound))
        if own and number > len(separate):
            bound = f"omitted: the joints of this arm are 1 to {len(separate)}"
            raise ParameterError(Violation(f"joint{number}", dict(own), "", bound))
    for number, (joint, own) in enumerate(zip_longest(separate, each[: len(separate)]), start=1):
        try:
            joints.append(_change_joint(joint, {**all_joints, **(own or {})}))
        except ParameterError as error:
            raise error.within(f"joint{number}") if own else error from None
    at_tip = tuple(load for load in first.loads if load.acts_as == TIP)
    at_tip = at_tip if tip_loads is None else _read_tip_loads(tip_loads)
    first, *others = joints
    setup = arm.changed(**{**fields, "other_joints": tuple(others)})
    if setup.tip is not None and any("position" in settings for settings in (all_joints, *each)):
        raise reject_position(setup.tip)
    return first.changed(arm=setup, loads=(*first.loads, *at_tip))


def build_actuated_arm(
    name: str,
    actuators: Sequence[str],
    fields: Mapping[str, Any] = {},
    all_joints: Mapping[str, Any] = {},
) -> Configuration:
    """Build the configuration of an arm with an actuator in each joint.

    Args:
        name: Name of an arm.
        actuators: Name of the actuator of each joint, from joint 1 on; by default those of the arm.
            Fewer actuators than links make an arm of the first links.
        fields: As for `build_arm_experiment`.
        all_joints: As for `build_arm_experiment`.

    Returns:
        The configuration.

    Raises:
        ParameterError: As `build_arm_experiment`; or for a number of actuators that the arm cannot
            have.
    """
    fields, each = dict(fields), [{"actuator": actuator} for actuator in actuators]
    if actuators and name in ARMS:
        links = ARMS[name].build_links(len(actuators))
        fields |= {"links": links, "model": links}
        # Stored scripts rely on it: with another actuator in a joint, all joints begin with the
        # settings of their actuators, in place of those of the arm.
        if set(actuators) == {ARMS[name].actuator}:
            each = []
    return build_arm_experiment(name, fields, all_joints, each)


def split_joints(configuration: Configuration) -> tuple[Configuration, ...]:
    """Return the configuration of each joint as that of a single joint, without the arm."""
    on_joint = tuple(load for load in configuration.loads if load.acts_as != TIP)
    first, *others = configuration.joints
    return first.changed(arm=None, loads=on_joint), *others


def reject_position(tip: TipReference) -> ParameterError:
    """Build the error of a joint's position reference that a reference of the tip replaces."""
    bound = "None for a position reference of a joint, which the reference of the tip replaces"
    return ParameterError(Violation("arm.tip", tip.kind, "", bound))


def _read_tip_loads(tip_loads: Load | Sequence[Load]) -> tuple[Load, ...]:
    loads = read_loads(tip_loads, "tip_loads")
    for number, load in enumerate(loads):
        if load.acts_as != TIP:
            bound = "a load at the tip; give a load on a joint as loads of joint1, joint2 …"
            raise ParameterError(Violation(f"tip_loads[{number}]", load.kind, "", bound))
    return loads


def _build_named(name: str, arm: ArmParameters | None) -> Configuration:
    if not isinstance(name, str) or name not in ARMS:
        finding = f"there is no such arm as {name!r}; the arms are {', '.join(ARMS)}"
        raise ParameterError(Violation("experiment", name, "", "", finding=finding))
    named = ARMS[name]
    links = named.links if arm is None else arm
    if not isinstance(links, ArmParameters):
        raise ParameterError(Violation("arm", links, "", "svsa.ArmParameters"))
    inertias = compute_joint_inertias(links)
    for number, inertia in enumerate(inertias, start=1):
        name = f"the mean inertia of the arm about joint {number}"
        check_number(name, inertia, "kg·m²", *INERTIAS_KG_M2)
    first, *others = (
        _build_joint(named.actuator, inertia, motion, stiffness=named.stiffness_nm_per_rad)
        for inertia, motion in zip(inertias, cycle(named.motions), strict=False)
    )
    return first.changed(arm=ArmSetup(links=links, model=links, other_joints=tuple(others)))


def _build_joint(
    actuator: str, inertia: float, position: AnyPosition, **settings: Any
) -> Configuration:
    """The configuration of a joint with the prototype of an actuator. inertia: kg·m²."""
    changes = {"link_inertia_kg_m2": inertia}
    joint = build_actuator_experiment(actuator, PAPERS_LAW, False, changes, changes)
    return change_configuration(joint, {"position": position, **settings})


def _change_joint(joint: Configuration, settings: dict[str, Any]) -> Configuration:
    """`change_configuration`; the name of an actuator leaves the nominal link inertia as it is."""
    if isinstance(actuator := settings.get("actuator"), str):
        joint = _build_joint(actuator, joint.nominal.link_inertia_kg_m2, joint.position)
        settings = {name: value for name, value in settings.items() if name != "actuator"}
    return change_configuration(joint, settings)

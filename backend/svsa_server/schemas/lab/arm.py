"""Requests and answers about the arm of a session."""

from typing import Any, Literal

from pydantic import BaseModel, Field

from svsa.actuators.arm.parameters import ArmParameters
from svsa.control.arm_payload import PayloadAdaptation
from svsa.control.installed import PAPERS_LAW, InstalledLaw
from svsa.inputs.checked import Checked, Flag, Whole, quantity
from svsa.runs.definition.arm_experiment import ARMS, build_actuated_arm
from svsa.runs.definition.configuration import MAX_JOINTS, ArmSetup, Configuration
from svsa.simulation.arm.tip_reference import TipReference
from svsa.simulation.plant.effects import IDEAL, Effects
from svsa_server.schemas.lab.law import InstalledLane

AT_ONCE = ("feedforward", "adaptation")
"""Fields of the arm that a session changes without a restart."""


class NamedArmState(BaseModel):
    """An arm of the lab."""

    name: str
    title: str
    description: str
    actuator: str = Field(description="Default actuator of its joints: see GET /actuators")
    links: ArmParameters


class FromArm(Checked):
    """An arm's default experiment, running: its joints follow sines, or the tip a path."""

    source: Literal["arm"] = quantity("", "An arm", alias="from")
    arm: str = quantity("", "Name of an arm: see GET /arms", default="rods", max_length=40)
    actuators: tuple[str, ...] | None = quantity(
        "",
        "Installed actuator of each joint, from joint 1 on; by default that of the arm. Fewer"
        " actuators than links make an arm of the first links",
        min_length=1,
        max_length=MAX_JOINTS,
        default=None,
    )
    law: InstalledLaw = quantity("", "Law of all joints: see GET /laws", default=PAPERS_LAW)
    comparisons: tuple[InstalledLane, ...] = quantity(
        "", "Controller of all joints of a second arm", max_length=1, default=()
    )
    feedforward: Flag = quantity("", "Whether the laws get the arm feedforward", default=False)
    tip: TipReference | None = quantity(
        "", "Reference of the tip, in place of those of the joints", default=None
    )
    effects: Effects = quantity(
        "", "Effects of a real bench that the simulation includes", default=IDEAL
    )
    seed: Whole = quantity("", "Seed of the sensor noise", ge=0, le=2**63 - 1, default=0)

    def list_actuators(self) -> tuple[str, ...]:
        """Return the actuator of each joint."""
        if self.actuators or self.arm not in ARMS:
            return self.actuators or ()
        arm = ARMS[self.arm]
        return (arm.actuator,) * len(arm.links.chain)

    def build_configuration(self) -> Configuration:
        """Build the session's configuration.

        Raises:
            ParameterError: If a value is invalid.
        """
        all_joints = {
            "law": self.law,
            "comparisons": self.comparisons,
            "effects": self.effects,
            "seed": self.seed,
        }
        settings: dict[str, Any] = {"feedforward": self.feedforward, "tip": self.tip}
        return build_actuated_arm(self.arm, self.actuators or (), settings, all_joints)


class ArmPatch(Checked):
    """Changes of the arm; omitted fields are unchanged."""

    feedforward: Flag = quantity("", "Whether the laws get the arm feedforward", default=False)
    adaptation: PayloadAdaptation | None = quantity(
        "", "Estimate of the mass at the tip; null: none", default=None
    )
    tip: TipReference | None = quantity(
        "", "Reference of the tip; null: those of the joints; restarts the run", default=None
    )
    links: ArmParameters = quantity("", "The links; restarts the run", default=None)
    model: ArmParameters = quantity(
        "", "The links in the model of the feedforward; restarts the run", default=None
    )

    def list_given(self) -> dict[str, Any]:
        """Return the given values by field."""
        return {name: getattr(self, name) for name in self.model_fields_set}

    def apply_to(self, arm: ArmSetup) -> ArmSetup:
        """Return the arm with the given values.

        Raises:
            ParameterError: If a value is invalid.
        """
        return arm.changed(**self.list_given())

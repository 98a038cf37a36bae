"""Inputs of the loop of an arm, and its state from tick to tick.

A tuple has one value for each joint, joint 1 first.
"""

from typing import NamedTuple, TypeAlias

import numpy as np

from svsa.actuators.arm.dynamics import Arm
from svsa.actuators.signals import State
from svsa.control.arm_feedforward import Known
from svsa.control.arm_payload import Adaptation, Payload
from svsa.control.call import BoundLaw
from svsa.simulation.loop.lane import Blocks, Inputs, LaneState

States: TypeAlias = tuple[State, ...]
Laws: TypeAlias = tuple[BoundLaw, ...]


class ArmBlocks(NamedTuple):
    """The blocks of an arm. arm: of the plant. model: of the feedforward. feeds: whether it acts.

    elbow: sign of q2 where the references are those of the tip, x and y (m) in place of those of
    joint 1 and joint 2; else 0. adaptation: of the payload; `NO_ADAPTATION` where there is none.

    joints: the `Blocks` of each joint, whose link inertia the plant does not use.
    """

    arm: Arm
    model: Arm
    feeds: bool
    elbow: float
    adaptation: Adaptation
    joints: tuple[Blocks, ...]


class ArmInputs(NamedTuple):
    """Inputs of an arm. joints: references and torques of each joint. tip: the table of
    `tip_loads`.
    """

    joints: tuple[Inputs, ...]
    tip: np.ndarray


class ArmState(NamedTuple):
    """What an arm carries: the lanes of its joints, feedforward of the next tick, payload."""

    joints: tuple[LaneState, ...]
    known: tuple[Known, ...]
    payload: Payload

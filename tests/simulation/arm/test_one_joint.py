"""The loop of an arm with one joint against the loop of a single actuator, to the bit."""

import numpy as np
import pytest

import svsa
from svsa.actuators.arm.dynamics import Arm
from svsa.actuators.signals import CHANNELS
from svsa.control.arm_payload import NO_ADAPTATION, Payload
from svsa.runs.definition.paper import get_figure
from svsa.runs.execution.run import Run
from svsa.simulation.arm.lane import ArmBlocks, ArmInputs, ArmState
from svsa.simulation.arm.loop import advance_arm, plan
from svsa.simulation.arm.tip_loads import build_tip_table
from svsa.simulation.loop.loop import advance

TICKS = 6000


@pytest.mark.exhaustive
@pytest.mark.parametrize("effects", [svsa.IDEAL, svsa.RIG])
def test_arm_of_one_joint_has_the_samples_of_a_single_actuator(effects):
    """With the load of the paper from 5 s on."""
    run = Run(get_figure("4a").build_configuration("ndobc").changed(effects=effects, seed=3))
    alone, (joint,), (law,), (lane,) = (
        np.empty((TICKS, len(CHANNELS))),
        run.blocks,
        run.laws,
        run.lanes,
    )
    advance(joint, law, run.inputs, lane, 0, alone)
    link = Arm(((joint.plant.M,),), (0.0,), (1.0,), 0.0)
    blocks = ArmBlocks(link, link, False, 0.0, NO_ADAPTATION, (joint,))
    inputs = ArmInputs((run.inputs,), build_tip_table((), run.period_s))
    state, samples = ArmState((lane,), plan(blocks, inputs, 0), Payload()), np.empty_like(alone)
    _, ticks, _ = advance_arm(blocks, (law,), inputs, state, 0, (samples,))
    assert ticks == TICKS
    assert np.array_equal(samples, alone)

"""The inputs of the loop are rebuilt only where a change affects them."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

import svsa
from svsa.runs.definition.command import Set, build_command
from svsa.runs.execution.blocks import bind_law, build_blocks
from svsa.runs.execution.run import Run
from tests.runs.session.scripts import ARGUMENTS, scripted
from tests.runs.session.sessions import build_configuration

FL = svsa.Lane(law="fl")
PUSH = svsa.PushLoad(torque_nm=(1.0, 0.0, 0.0), hold_s=0.1)
kinds = st.sampled_from(sorted({*ARGUMENTS} - {"load", "unload", "stop"}))
changes = st.lists(
    kinds.flatmap(lambda kind: st.tuples(st.just(kind), ARGUMENTS[kind])), min_size=1, max_size=8
)


def build_run():
    return Run(build_configuration(comparisons=(FL,)))


@scripted
@given(changes)
def test_inputs_of_the_loop_equal_those_built_from_the_start(drawn):
    run = build_run()
    for kind, argument in drawn:
        try:
            run.change(build_command(0, kind, argument))
        except svsa.SvsaError:
            continue
    c = run.configuration
    assert len(run.blocks) == len(run.laws) == len(run.lanes) == len(c.lanes)
    for lane, blocks, law in zip(c.lanes, run.blocks, run.laws, strict=True):
        assert blocks == build_blocks(c, lane, run.mu0)
        built = bind_law(c, lane, blocks)
        assert law.function == built.function
        np.testing.assert_array_equal(law.constants, built.constants)
        np.testing.assert_array_equal(law.nominal, built.nominal)


def test_load_or_reference_leaves_blocks_and_laws_unchanged():
    run = build_run()
    before = [*run.blocks, *run.laws]
    load = run.add_load(PUSH)
    run.change(Set("position", svsa.ConstantPosition(position_rad=0.1)))
    run.change(Set("stiffness", svsa.ConstantStiffness(stiffness_nm_per_rad=40.0)))
    run.remove_load(load.number)
    after = [*run.blocks, *run.laws]
    assert all(one is other for one, other in zip(before, after, strict=True))


def test_gains_leave_the_blocks_and_bind_the_law_again():
    run = build_run()
    (blocks, *_), (law, *_) = run.blocks, run.laws
    run.change(Set("gains", svsa.Gains.from_poles([-50.0] * 4, [-30.0] * 2)))
    assert run.blocks[0] is blocks
    assert run.laws[0] is not law


def test_observer_leaves_the_law_unchanged():
    run = build_run()
    (blocks, *_), (law, *_) = run.blocks, run.laws
    run.change(Set("observer", svsa.ObserverBandwidth(bandwidth_rad_per_s=(70.0,) * 3)))
    assert run.blocks[0] is not blocks
    assert run.laws[0] is law

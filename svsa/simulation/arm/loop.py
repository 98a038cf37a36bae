"""The control loop of an arm: a controller per joint, one plant.

The order of a tick is that of `svsa.simulation.loop.loop.run_tick`, and each joint's law, limits,
delay, drives, sensors and observer are the ones of a single joint. Only the plant is coupled.
"""

import math

import numpy as np

from svsa.actuators.arm.dynamics import add_tip_mass
from svsa.actuators.arm.motion import Motion, compute_joint_motions
from svsa.actuators.domain import INSIDE, NOT_FINITE, check_domain
from svsa.actuators.dynamics import ExternalLoad, InternalTorque, compute_internal_torque
from svsa.actuators.elasticity import replace_link_inertia
from svsa.actuators.signals import Disturbance, Reference, State, Torque
from svsa.control.arm_feedforward import Known, compute_known, read_motion, shift_reference
from svsa.control.arm_payload import update_payload
from svsa.control.call import BoundLaw, Call, build_call, compute_law
from svsa.control.limits import limit_motors
from svsa.numerics.borrowed import borrow
from svsa.numerics.compilation import compiled
from svsa.simulation.arm.lane import ArmBlocks, ArmInputs, ArmState, Laws
from svsa.simulation.arm.plant import compute_arm_rate, integrate_arm
from svsa.simulation.arm.tip_loads import compute_tip_action
from svsa.simulation.loop.lane import (
    Action,
    Blocks,
    Inputs,
    LaneState,
    borrow_inputs,
    borrow_law,
    remember,
)
from svsa.simulation.loop.loop import delay, follow, measure, read_reference
from svsa.simulation.loop.publish import publish
from svsa.simulation.plant.effects.current_lag import compute_lagged_torque
from svsa.simulation.plant.load_table import compute_load


@compiled
def plan(blocks: ArmBlocks, inputs: ArmInputs, tick: int) -> tuple[Known, Known]:
    """Read both references at `tick`, with the feedforward if there is one."""
    time = tick * blocks.joint1.period
    r1, r2 = read_reference(inputs.joint1, time), read_reference(inputs.joint2, time)
    if blocks.elbow != 0.0:
        x, y = read_motion(r1), read_motion(r2)
        q1, q2 = compute_joint_motions(blocks.arm, blocks.elbow, x, y)
        r1, r2 = replace_motion(r1, q1), replace_motion(r2, q2)
    if blocks.feeds:
        return compute_known(blocks.model, blocks.joint1.nominal.M, blocks.joint2.nominal.M, r1, r2)
    return Known(r1, 0.0, 0.0, 0.0), Known(r2, 0.0, 0.0, 0.0)


@compiled
def replace_motion(reference: Reference, q: Motion) -> Reference:
    """The reference with another q_d and its derivatives."""
    r = reference
    return Reference(q.d0, q.d1, q.d2, q.d3, q.d4, r.sigma, r.dsigma, r.ddsigma)


@compiled
def decide_joint(
    blocks: Blocks, feeds: bool, call: Call, lane: LaneState, known: Known, tick: int
) -> Torque:
    """The controller of one joint: its law's torque after the limits, N·m."""
    reference, estimate = known.reference, lane.estimate
    if feeds:
        reference = shift_reference(blocks.nominal, lane.known, known)
        estimate = Disturbance(estimate.w2 - known.w, estimate.w4, estimate.w6)
    measured = measure(blocks, call, lane.x, tick)
    x, applied, period = lane.known, lane.applied, blocks.period
    torque = compute_law(call, x, reference, estimate, applied, period, measured)
    return limit_motors(blocks.plant, torque, Torque(blocks.torque1_max, blocks.torque2_max))


@compiled
def act_on_joint(
    blocks: Blocks, inputs: Inputs, lane: LaneState, torque: Torque, tick: int
) -> tuple[tuple[float, ...], Torque, Torque, ExternalLoad]:
    """Delay, drive and loads of one joint: queue, delayed and actual torque (N·m), and load."""
    limited, delayed = delay(blocks.effects, lane.limited, torque)
    load = compute_load(inputs.loads, tick, blocks.period, tick * blocks.period)
    actual = compute_lagged_torque(lane.actual, delayed, blocks.effects.current_lag, 0.0)
    return limited, delayed, actual, load


@compiled
def follow_joint(
    blocks: Blocks,
    lane: LaneState,
    F: InternalTorque,
    action: Action,
    x: State,
    before: Known,
    after: Known,
    tick: int,
) -> tuple[LaneState, InternalTorque]:
    """Sensors and observer of one joint: the observer estimates what w_d does not explain.

    ŵ2 = w_d + rest, and the rest is filtered: half of the known change is added before the update
    and half after it.
    """
    half = 0.5 * (after.w - before.w)
    lane, F = follow(blocks, shift_estimate(lane, half), F, action, x, tick)
    return shift_estimate(lane, half), F


@compiled
def shift_estimate(lane: LaneState, w: float) -> LaneState:
    """The lane with w (N·m) added to ŵ2."""
    e = Disturbance(lane.estimate.w2 + w, lane.estimate.w4, lane.estimate.w6)
    return LaneState(lane.x, lane.known, e, lane.actual, lane.applied, lane.limited, lane.memory)


@compiled
def adapt_joint(blocks: Blocks, inertia: float) -> Blocks:
    """The blocks of a joint with `inertia` (kg·m²) added to M of the nominal model."""
    b = blocks
    nominal = replace_link_inertia(b.nominal, b.nominal.M + inertia)
    return Blocks(
        b.plant, nominal, b.shares, b.torque1_max, b.torque2_max, b.effects, b.decay, b.domain,
        b.period, b.steps,
    )  # fmt: skip


@compiled
def adapt_blocks(blocks: ArmBlocks, mass: float) -> ArmBlocks:
    """The blocks of an arm whose models have a further mass at the tip, kg."""
    b, model = blocks, add_tip_mass(blocks.model, mass)
    inertia2 = mass * model.length2 * model.length2
    inertia1 = mass * model.length1 * model.length1 + inertia2
    joint1, joint2 = adapt_joint(b.joint1, inertia1), adapt_joint(b.joint2, inertia2)
    return ArmBlocks(b.arm, model, b.feeds, b.elbow, b.adaptation, joint1, joint2)


@compiled
def adapt(blocks: ArmBlocks, mass: float, laws: Laws) -> ArmBlocks:
    """`adapt_blocks`; also M, the first number of the packed nominal model of each law."""
    adapted = adapt_blocks(blocks, mass)
    laws[0].nominal[0] = adapted.joint1.nominal.M
    laws[1].nominal[0] = adapted.joint2.nominal.M
    return adapted


@compiled
def run_arm_tick(
    blocks: ArmBlocks,
    laws: Laws,
    inputs: ArmInputs,
    arm: ArmState,
    F1: InternalTorque,
    F2: InternalTorque,
    tick: int,
    row1: np.ndarray,
    row2: np.ndarray,
) -> tuple[ArmState, InternalTorque, InternalTorque, int, int]:
    """One tick of both joints: reference, controllers, write, plant, read, observers, publish.

    F1, F2: F_n(x̂) of each joint. row1, row2: samples, (channels,), written. Returns arm, F1, F2,
    and the code of each joint: other than `INSIDE` says why the run ends at this tick.
    """
    bare, adaptation = blocks.model, blocks.adaptation
    if adaptation.share > 0.0:
        blocks = adapt(blocks, arm.payload.mass, laws)
    joint1, joint2, lane1, lane2 = blocks.joint1, blocks.joint2, arm.joint1, arm.joint2
    code1 = check_domain(joint1.domain, joint1.plant, lane1.x)
    code2 = check_domain(joint2.domain, joint2.plant, lane2.x)
    if code1 != INSIDE or code2 != INSIDE:
        return arm, F1, F2, code1, code2
    known1, known2 = arm.known1, arm.known2
    call1, call2 = build_call(laws[0], lane1.memory), build_call(laws[1], lane2.memory)
    torque1 = decide_joint(joint1, blocks.feeds, call1, lane1, known1, tick)
    torque2 = decide_joint(joint2, blocks.feeds, call2, lane2, known2, tick)
    code1 = INSIDE if abs(torque1.u1 + torque1.u2) < math.inf else NOT_FINITE
    code2 = INSIDE if abs(torque2.u1 + torque2.u2) < math.inf else NOT_FINITE
    if code1 != INSIDE or code2 != INSIDE:
        return arm, F1, F2, code1, code2
    limited1, delayed1, actual1, load1 = act_on_joint(joint1, inputs.joint1, lane1, torque1, tick)
    limited2, delayed2, actual2, load2 = act_on_joint(joint2, inputs.joint2, lane2, torque2, tick)
    x, loads, tip = (lane1.x, lane2.x), (load1, load2), compute_tip_action(inputs.tip, tick)
    loaded = add_tip_mass(blocks.arm, tip.mass)
    rate = compute_arm_rate(
        blocks, loaded, inputs.tip, tick, x, (actual1, actual2), loads, tip.force
    )
    action1 = Action(limited1, delayed1, actual1, load1, rate[0])
    action2 = Action(limited2, delayed2, actual2, load2, rate[1])
    publish(True, joint1, known1.reference, lane1, F1, call1, action1, tick, row1)
    publish(True, joint2, known2.reference, lane2, F2, call2, action2, tick, row2)
    start, delayed = (lane1.actual, lane2.actual), (delayed1, delayed2)
    x1, x2 = integrate_arm(blocks, inputs, x, rate, start, delayed, loads, tip, tick)
    next1, next2 = plan(blocks, inputs, tick + 1)
    old, before1, before2, payload = (lane1.known, lane2.known), F1, F2, arm.payload
    lane1, F1 = follow_joint(joint1, lane1, F1, action1, x1, known1, next1, tick)
    lane2, F2 = follow_joint(joint2, lane2, F2, action2, x2, known2, next2, tick)
    if adaptation.share > 0.0:
        new, period = (lane1.known, lane2.known), joint1.period
        payload = update_payload(
            adaptation, bare, payload, old, new, (before1, F1), (before2, F2), period
        )
    return ArmState(lane1, lane2, next1, next2, payload), F1, F2, INSIDE, INSIDE


@compiled
def copy_law(law: BoundLaw, nominal: np.ndarray) -> BoundLaw:
    """The same `BoundLaw` with another packed nominal model, without owning its arrays."""
    one = borrow_law(law)
    return BoundLaw(one.function, nominal, one.constants, one.is_own, one.is_measuring)


@compiled
def advance_arm(
    blocks: ArmBlocks,
    law1: BoundLaw,
    law2: BoundLaw,
    inputs: ArmInputs,
    arm: ArmState,
    first: int,
    samples1: np.ndarray,
    samples2: np.ndarray,
    masses: np.ndarray,
) -> tuple[ArmState, int, int, int]:
    """Run many ticks without the GIL. samples1, samples2: (ticks, channels) of a joint, written.

    masses: (ticks,), m̂ at the beginning of each tick, kg, written. arm: at the tick `first`, which
    stays as it is. Returns (arm, ticks done, code of joint 1, code of joint 2), as
    `svsa.simulation.loop.loop.advance`.
    """
    memory1, memory2 = arm.joint1.memory.copy(), arm.joint2.memory.copy()
    rows1, rows2 = borrow(samples1), borrow(samples2)
    nominal1, nominal2 = law1.nominal.copy(), law2.nominal.copy()
    laws = copy_law(law1, borrow(nominal1)), copy_law(law2, borrow(nominal2))
    given = ArmInputs(
        borrow_inputs(inputs.joint1), borrow_inputs(inputs.joint2), borrow(inputs.tip)
    )
    lane1 = remember(arm.joint1, borrow(memory1))
    lane2 = remember(arm.joint2, borrow(memory2))
    F1 = compute_internal_torque(blocks.joint1.nominal, lane1.known)
    F2 = compute_internal_torque(blocks.joint2.nominal, lane2.known)
    now = ArmState(lane1, lane2, arm.known1, arm.known2, arm.payload)
    done, code1, code2 = 0, INSIDE, INSIDE
    while done < rows1.shape[0] and code1 == INSIDE and code2 == INSIDE:
        masses[done] = now.payload.mass
        now, F1, F2, code1, code2 = run_arm_tick(
            blocks, laws, given, now, F1, F2, first + done, rows1[done], rows2[done]
        )
        done += code1 == INSIDE and code2 == INSIDE
    kept1, kept2 = remember(now.joint1, memory1), remember(now.joint2, memory2)
    return ArmState(kept1, kept2, now.known1, now.known2, now.payload), done, code1, code2

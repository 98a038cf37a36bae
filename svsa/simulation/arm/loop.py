"""The control loop of an arm: a controller per joint, one plant.

The order of a tick is that of `svsa.simulation.loop.loop.run_tick`, and each joint's law, limits,
delay, drives, sensors and observer are the ones of a single joint. Only the plant is coupled.
"""

import math
from operator import getitem

import numpy as np

from svsa.actuators.arm.dynamics import add_tip_mass
from svsa.actuators.arm.motion import Motion, compute_joint_motions
from svsa.actuators.domain import INSIDE, NOT_FINITE, check_domain
from svsa.actuators.dynamics import InternalTorque, compute_internal_torque
from svsa.actuators.elasticity import replace_link_inertia
from svsa.actuators.signals import CHANNEL_INDEX, Disturbance, Reference, State, Torque
from svsa.control.arm_feedforward import Known, compute_known, read_motion, shift_reference
from svsa.control.arm_payload import update_payload
from svsa.control.call import BoundLaw, Call, build_call, compute_law
from svsa.control.limits import limit_motors
from svsa.numerics.borrowed import borrow, keep
from svsa.numerics.compilation import compiled
from svsa.numerics.fields import each, full_like, replace_item, take
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

_PAYLOAD = CHANNEL_INDEX["payload_estimate_kg"]


@compiled
def plan(blocks: ArmBlocks, inputs: ArmInputs, tick: int) -> tuple[Known, ...]:
    """Read all references at `tick`, with the feedforward if there is one."""
    references = each(read_reference, (inputs.joints, tick * blocks.joints[0].period))
    if blocks.elbow != 0.0:
        x, y = read_motion(references[0]), read_motion(references[-1])
        q1, q2 = compute_joint_motions(blocks.arm, blocks.elbow, x, y)
        first, last = replace_motion(references[0], q1), replace_motion(references[-1], q2)
        references = replace_item(references, 0, first)
        references = replace_item(references, len(references) - 1, last)
    if blocks.feeds:
        inertias = take(take(blocks.joints, "nominal"), "M")
        return compute_known(blocks.model, inertias, references)
    return each(plan_alone, (references,))


@compiled
def plan_alone(reference: Reference) -> Known:
    """The reference of a joint without a feedforward."""
    return Known(reference, 0.0, 0.0, 0.0)


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
) -> Action:
    """Delay, drive and loads of one joint; the coupled plant adds the rate, see `replace_rate`."""
    limited, delayed = delay(blocks.effects, lane.limited, torque)
    load = compute_load(inputs.loads, tick, blocks.period, tick * blocks.period)
    actual = compute_lagged_torque(lane.actual, delayed, blocks.effects.current_lag, 0.0)
    return Action(limited, delayed, actual, load, lane.x)


@compiled
def replace_rate(action: Action, rate: State) -> Action:
    """The action with ẋ of the coupled plant."""
    return Action(action.limited, action.delayed, action.actual, action.load, rate)


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
    return LaneState(
        lane.x, lane.known, e, lane.actual, lane.applied, lane.limited, lane.memory, lane.spring
    )


@compiled
def shift_inertia(lane: LaneState, before: Blocks, after: Blocks, known: Known) -> LaneState:
    """The lane after a change of M of the nominal model: w2 changes by ΔM q̈, not by that of w_d."""
    return shift_estimate(lane, (after.nominal.M - before.nominal.M) * known.reference.ddq)


@compiled
def adapt_joint(blocks: Blocks, inertia: float) -> Blocks:
    """The blocks of a joint with `inertia` (kg·m²) added to M of the nominal model."""
    b = blocks
    nominal = replace_link_inertia(b.nominal, b.nominal.M + inertia)
    return Blocks(
        b.plant, nominal, b.shares, b.torque1_max, b.torque2_max, b.effects, b.decay, b.domain,
        b.period, b.steps, b.spring,
    )  # fmt: skip


@compiled
def adapt_blocks(blocks: ArmBlocks, mass: float) -> ArmBlocks:
    """The blocks of an arm whose models have a further mass at the tip, kg."""
    b, model = blocks, add_tip_mass(blocks.model, mass)
    inertias, inertia = model.lengths, 0.0
    for j in range(len(inertias) - 1, -1, -1):
        inertia = mass * model.lengths[j] * model.lengths[j] + inertia
        inertias = replace_item(inertias, j, inertia)
    joints = each(adapt_joint, (b.joints, inertias))
    return ArmBlocks(b.arm, model, b.feeds, b.elbow, b.adaptation, joints)


@compiled
def adapt_law(law: BoundLaw, blocks: Blocks) -> None:
    """Write M of the nominal model, the first number of the packed one of the law."""
    law.nominal[0] = blocks.nominal.M


@compiled
def check_torque(torque: Torque) -> int:
    """`INSIDE` for finite torques."""
    return INSIDE if abs(torque.u1 + torque.u2) < math.inf else NOT_FINITE


@compiled
def are_inside(codes: tuple[int, ...]) -> bool:
    """Whether no joint has a reason to end the run."""
    inside = True
    for j in range(len(codes)):
        inside = inside and codes[j] == INSIDE
    return inside


@compiled
def run_arm_tick(
    blocks: ArmBlocks,
    laws: Laws,
    inputs: ArmInputs,
    arm: ArmState,
    F: tuple[InternalTorque, ...],
    tick: int,
    rows: tuple[np.ndarray, ...],
) -> tuple[ArmState, tuple[InternalTorque, ...], tuple[int, ...]]:
    """One tick of all joints: reference, controllers, write, plant, read, observers, publish.

    F: F_n(x̂) of each joint. rows: sample of each joint, (channels,), written. Returns arm, F, and
    the code of each joint: other than `INSIDE` says why the run ends at this tick.
    """
    bare, adaptation, lanes, known = blocks, blocks.adaptation, arm.joints, arm.known
    if adaptation.share > 0.0:
        blocks = adapt_blocks(bare, arm.payload.mass)
        each(adapt_law, (laws, blocks.joints))
    joints = blocks.joints
    codes = each(check_domain, (take(joints, "domain"), take(joints, "plant"), take(lanes, "x")))
    if not are_inside(codes):
        return arm, F, codes
    calls = each(build_call, (laws, take(lanes, "memory")))
    torques = each(decide_joint, (joints, blocks.feeds, calls, lanes, known, tick))
    codes = each(check_torque, (torques,))
    if not are_inside(codes):
        return arm, F, codes
    actions = each(act_on_joint, (joints, inputs.joints, lanes, torques, tick))
    x, tip = take(lanes, "x"), compute_tip_action(inputs.tip, tick)
    actual, loads = take(actions, "actual"), take(actions, "load")
    loaded = add_tip_mass(blocks.arm, tip.mass)
    rate = compute_arm_rate(blocks, loaded, inputs.tip, tick, x, actual, loads, tip.force)
    actions = each(replace_rate, (actions, rate))
    references = take(known, "reference")
    each(publish, (True, joints, references, lanes, F, calls, actions, tick, rows))
    start, delayed = take(lanes, "actual"), take(actions, "delayed")
    x = integrate_arm(blocks, inputs, x, rate, start, delayed, loads, tip, tick)
    planned = plan(blocks, inputs, tick + 1)
    old, before, payload = take(lanes, "known"), F, arm.payload
    followed = each(follow_joint, (joints, lanes, F, actions, x, known, planned, tick))
    lanes, F = take(followed, 0), take(followed, 1)
    if adaptation.share > 0.0:
        new, period = take(lanes, "known"), joints[0].period
        payload = update_payload(adaptation, bare.model, payload, old, new, before, F, period)
        if adaptation.shifts:
            adapted = adapt_blocks(bare, payload.mass)
            lanes = each(shift_inertia, (lanes, joints, adapted.joints, planned))
            planned = plan(adapted, inputs, tick + 1)
    return ArmState(lanes, planned, payload), F, codes


@compiled
def write_payload(row: np.ndarray, mass: float) -> None:
    """Write m̂, kg, into the sample of a joint."""
    row[_PAYLOAD] = mass


@compiled
def copy_array(array: np.ndarray) -> np.ndarray:
    """A copy, which owns its memory."""
    return array.copy()


@compiled
def borrow_copied_law(law: BoundLaw, nominal: np.ndarray) -> BoundLaw:
    """The law with another packed nominal model, without owning its arrays."""
    borrowed = borrow_law(law)
    return BoundLaw(
        borrowed.function, borrow(nominal), borrowed.constants, law.is_own, law.is_measuring
    )


@compiled
def advance_arm(
    blocks: ArmBlocks,
    laws: Laws,
    inputs: ArmInputs,
    arm: ArmState,
    first: int,
    samples: tuple[np.ndarray, ...],
) -> tuple[ArmState, int, tuple[int, ...]]:
    """Run many ticks without the GIL. samples: (ticks, channels) of each joint, written.

    arm: at the tick `first`, which stays as it is. Returns (arm, ticks done, code of each joint),
    as `svsa.simulation.loop.loop.advance`.
    """
    memories = each(copy_array, (take(arm.joints, "memory"),))
    springs = each(copy_array, (take(arm.joints, "spring"),))
    nominals = each(copy_array, (take(laws, "nominal"),))
    own = each(borrow_copied_law, (laws, nominals))
    borrowed = ArmInputs(each(borrow_inputs, (inputs.joints,)), borrow(inputs.tip))
    lanes = each(remember, (arm.joints, each(borrow, (memories,)), each(borrow, (springs,))))
    F = each(compute_internal_torque, (take(blocks.joints, "nominal"), take(lanes, "known")))
    now = ArmState(lanes, arm.known, arm.payload)
    rows, done, codes = each(borrow, (samples,)), 0, full_like(F, int(INSIDE))
    while done < samples[0].shape[0] and are_inside(codes):
        row, mass = each(getitem, (rows, done)), now.payload.mass
        now, F, codes = run_arm_tick(blocks, own, borrowed, now, F, first + done, row)
        if blocks.adaptation.share > 0.0:
            each(write_payload, (row, mass))
        done += are_inside(codes)
    keep(nominals)
    reached = each(remember, (now.joints, memories, springs))
    return ArmState(reached, now.known, now.payload), done, codes

"""The plant of an arm without controllers: constant motor torques, loads at the tip."""

from svsa.actuators.arm.dynamics import add_tip_mass, compute_arm_energy, turn
from svsa.actuators.arm.parameters import RODS
from svsa.actuators.dynamics import ExternalLoad, compute_deflection
from svsa.actuators.elasticity import compute_coordinate
from svsa.actuators.signals import State, Torque
from svsa.actuators.spring import compute_elastic_energy
from svsa.runs.definition.arm_experiment import build_arm_experiment
from svsa.runs.execution.arm_run import ArmRun
from svsa.simulation.arm.plant import compute_arm_rate, integrate_arm
from svsa.simulation.arm.tip_loads import compute_tip_action

UNDAMPED = {
    "link_damping_nms_per_rad": 0.0,
    "motor1_damping_nms_per_rad": 0.0,
    "motor2_damping_nms_per_rad": 0.0,
}
AT_REST = Torque(0.0, 0.0)
NO_LOAD = ExternalLoad(0.0, 0.0, 0.0, 0.0, 0.0)
START = (
    State(0.3, 1.0, 0.25, -2.0, 0.0, 0.5),
    State(-0.5, 2.0, -0.42, 1.0, 0.0, -0.3),
)


def build_arm(arm=RODS, steps=1, period=0.001, tip_loads=(), damped=True, **both):
    """The constants of an arm and its inputs."""
    actuator = {} if damped else {"actuator": UNDAMPED}
    given = {"links": arm}
    settings = {"sampling": {"period_s": period}, **actuator, **both}
    settings |= {} if "actuator" in both else {"stiffness": 15.0}
    run = ArmRun(build_arm_experiment("rods", given, settings, tip_loads=tip_loads), steps)
    return run.arms[0], run.arm_inputs


def step(blocks, inputs, x, tick, torque=(AT_REST, AT_REST)):
    """All joints a period later."""
    tip = compute_tip_action(inputs.tip, tick)
    arm, loads = add_tip_mass(blocks.arm, tip.mass), (NO_LOAD,) * len(x)
    rate = compute_arm_rate(blocks, arm, inputs.tip, tick, x, torque, loads, tip.force)
    return integrate_arm(blocks, inputs, x, rate, torque, torque, loads, tip, tick)


def move(blocks, inputs, x, ticks, torque=(AT_REST, AT_REST)):
    """The states at the beginning of each tick, and at the end."""
    states = [x]
    for tick in range(ticks):
        states.append(step(blocks, inputs, states[-1], tick, torque))
    return states


def compute_energy(blocks, x, mass=0.0):
    """Energy of links, motors and springs, J. mass: at the tip, kg."""
    q, dq = tuple(joint.q for joint in x), tuple(joint.dq for joint in x)
    energy = compute_arm_energy(add_tip_mass(blocks.arm, mass), turn(q), dq)
    for state, joint in zip(x, blocks.joints, strict=True):
        p = joint.plant
        energy += 0.5 * (p.B1 * state.dtheta1**2 + p.B2 * state.dtheta2**2)
        mu = compute_coordinate(p, state.theta2)
        energy += compute_elastic_energy(mu, compute_deflection(state), p.K)
    return energy

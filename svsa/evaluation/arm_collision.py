"""`svsa arm-collision`: the tip of an arm hits a wall, at low and high stiffness of the joints."""

import json
import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NamedTuple

import numpy as np
import typer
from rich.console import Console
from rich.table import Table

from svsa.control.installed import get_title
from svsa.control.law_names import AnyLaw
from svsa.errors import SvsaError
from svsa.inputs.output_file import check_picture

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from svsa.runs.definition.design import Lane
    from svsa.runs.result.arm import ArmResult
    from svsa.simulation.arm.tip_reference import TipMove
    from svsa.simulation.plant.loads.tip import AnyTipLoad, Wall

STIFFNESSES_NM_PER_RAD = (10.0, 20.0, 40.0, 80.0, 140.0)
DIRECTIONS = (1, -1)
WALL_N_PER_M, DAMPING_NS_PER_M = 2000.0, 10.0
IMPACT_S, HOLDING_S = 0.03, 0.5
REACH_M, _HEIGHT_M, _WALL_M = 0.2, -0.4, 0.1
_MOVE_S, DURATION_S, SHOWN_S = 1.2, 3.0, 1.0


class Collision(NamedTuple):
    """A collision of the tip with a wall.

    Attributes:
        stiffness_nm_per_rad: σ of both joints, N·m/rad.
        direction: 1 if the tip moves in the direction of x, −1 if it moves against it.
        effective_mass_kg: Mass of the tip in the direction of the wall at the first contact, see
            `svsa.simulation.arm.contact.compute_effective_mass`. This and the following numbers
            are NaN without a contact.
        speed_m_per_s: Speed towards the wall at the first contact.
        impact_n: Largest force in the first 30 ms of the contact.
        peak_n: Largest force.
        work_j: Largest energy that the wall takes.
        holding_n: Mean force of the last 0.5 s; NaN after a fault.
        fault: Code of the fault that ended the run, or None.
        time_s: Time from the first contact on, (samples,), s.
        force_n: Force of the wall, (samples,), N.
        depth_m: Depth of the tip behind the surface of the wall, (samples,), m.
    """

    stiffness_nm_per_rad: float
    direction: int
    effective_mass_kg: float
    speed_m_per_s: float
    impact_n: float
    peak_n: float
    work_j: float
    holding_n: float
    fault: str | None
    time_s: np.ndarray
    force_n: np.ndarray
    depth_m: np.ndarray


def build_move(direction: int) -> "TipMove":
    """Build a straight movement of the tip by 0.4 m. direction: 1 along x, −1 against it."""
    from svsa.simulation.arm.tip_reference import TipMove

    reach = direction * REACH_M
    return TipMove(start_m=(-reach, _HEIGHT_M), end_m=(reach, _HEIGHT_M), duration_s=_MOVE_S)


def build_collision(
    direction: int, wall_n_per_m: float, damping_ns_per_m: float
) -> "tuple[TipMove, Wall]":
    """Build the movement of the tip, and a wall 0.1 m before its end.

    Args:
        direction: 1 or −1, of the movement along x.
        wall_n_per_m: Contact stiffness of the wall, N/m.
        damping_ns_per_m: Contact damping of the wall, N·s/m.

    Returns:
        The movement and the wall.
    """
    from svsa.simulation.plant.loads.tip import Wall

    return build_move(direction), Wall(
        normal_rad=math.pi if direction > 0 else 0.0,
        distance_m=-_WALL_M,
        stiffness_n_per_m=wall_n_per_m,
        damping_ns_per_m=damping_ns_per_m,
    )


def simulate_horizontal(
    law: "str | Lane", stiffness: float, move: "TipMove", load: "AnyTipLoad"
) -> "ArmResult":
    """Simulate two rods in a horizontal plane, with exact models and arm feedforward.

    Args:
        law: Law of both joints, by its name or with its parameters.
        stiffness: σ of both joints, N·m/rad.
        move: Movement of the tip.
        load: Load at the tip.

    Returns:
        The run, 3 s.
    """
    from svsa.actuators.arm.parameters import RODS
    from svsa.runs.definition.arm_experiment import build_arm_experiment
    from svsa.runs.result.simulate_arm import simulate_arm

    joint = build_arm_experiment("rods", {}, {})
    exact = joint.actuator.changed(link_inertia_kg_m2=joint.nominal.link_inertia_kg_m2)
    return simulate_arm(
        law=AnyLaw(law) if isinstance(law, str) else law,
        duration_s=DURATION_S,
        feedforward=True,
        tip=move,
        tip_loads=[load],
        arm=RODS.changed(gravity_m_per_s2=0.0),
        stiffness=stiffness,
        nominal=dict(exact),
    )


def measure_collision(
    law: "str | Lane",
    stiffness: float,
    direction: int,
    wall_n_per_m: float = WALL_N_PER_M,
    damping_ns_per_m: float = DAMPING_NS_PER_M,
) -> Collision:
    """Simulate a collision in a horizontal plane, with exact models and arm feedforward.

    Without gravity and model errors the tip arrives at the wall with the same speed at every
    stiffness.

    Args:
        law: Law of both joints, by its name or with its parameters.
        stiffness: σ of both joints, N·m/rad.
        direction: 1 or −1, of the movement along x.
        wall_n_per_m: Contact stiffness of the wall, N/m.
        damping_ns_per_m: Contact damping of the wall, N·s/m.

    Returns:
        Mass, speed, forces, work and signals of the collision.
    """
    # Imported here: every command of `svsa` imports this file.
    from svsa.simulation.arm.contact import compute_effective_mass

    move, wall = build_collision(direction, wall_n_per_m, damping_ns_per_m)
    run = simulate_horizontal(law, stiffness, move, wall)
    x = direction * run.tip_position_m[:, 0]
    force = -direction * run.wall_force_n[:, 0]
    period, fault = run.configuration.sampling.period_s, run.fault and run.fault.code
    if not np.any(force > 0.0):
        nan, empty = math.nan, np.empty(0)
        return Collision(
            stiffness, direction, nan, nan, nan, nan, nan, nan, fault, empty, empty, empty
        )
    first = int(np.argmax(force > 0.0))
    arm = run.configuration.require_arm().links.build()
    angles = tuple(float(joint["position_rad"][first]) for joint in run.joints)
    time, pushed, done = run.time_s[first:] - run.time_s[first], force[first:], x[first:]
    work = np.cumsum(0.5 * (pushed[1:] + pushed[:-1]) * np.diff(done))
    return Collision(
        stiffness,
        direction,
        compute_effective_mass(arm, angles, 0.0),
        float((x[first] - x[first - 1]) / period),
        float(pushed[time < IMPACT_S].max()),
        float(pushed.max()),
        float(work.max(initial=0.0)),
        math.nan if fault else float(pushed[-round(HOLDING_S / period) :].mean()),
        fault,
        time,
        pushed,
        done - _WALL_M,
    )


def draw_collisions(collisions: Sequence[Collision]) -> "Figure":
    """Draw force over time and over depth, a row per direction; needs the extra `plot`."""
    from matplotlib.figure import Figure

    from svsa.runs.result.plot import label_axes

    directions = list(dict.fromkeys(collision.direction for collision in collisions))
    figure = Figure(figsize=(9.0, 2.9 * len(directions)), layout="constrained")
    grid = figure.subplots(len(directions), 2, sharey=True, squeeze=False)
    for (left, right), direction in zip(grid, directions, strict=True):
        for collision in collisions:
            if collision.direction == direction:
                force_n, depth_mm = collision.force_n, 1000.0 * collision.depth_m
                label = f"σ = {collision.stiffness_nm_per_rad:g}"
                left.plot(collision.time_s, force_n, linewidth=1.2)
                right.plot(depth_mm, force_n, linewidth=1.2, label=label)
        sign = "+" if direction > 0 else "−"
        label_axes(left, f"Force, motion along {sign}x [N]")
        label_axes(right, "")
        left.set_xlim(0.0, SHOWN_S)
        right.set_xlim(left=0.0)
        left.set_xlabel("Time from the first contact [s]")
        right.set_xlabel("Depth [mm]")
    return figure


def arm_collision(
    law: Annotated[str, typer.Argument(help="Installed law of both joints.")] = "pd",
    wall: Annotated[
        float, typer.Option(help="Contact stiffness of the wall, N/m.", min=100.0, max=1e5)
    ] = WALL_N_PER_M,
    damping: Annotated[
        float, typer.Option(help="Contact damping of the wall, N·s/m.", min=0.0, max=200.0)
    ] = DAMPING_NS_PER_M,
    plot: Annotated[Path | None, typer.Option(help="Picture file (.png, .pdf, .svg).")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
) -> None:
    """Let the tip of an arm collide with a wall at several stiffnesses, in both directions."""
    check_picture("--plot", plot)
    try:
        collisions = [
            measure_collision(law, stiffness, direction, wall, damping)
            for direction in DIRECTIONS
            for stiffness in STIFFNESSES_NM_PER_RAD
        ]
    except SvsaError as error:
        Console(stderr=True).print(f"Error: {error}", style="bold red", markup=False)
        raise typer.Exit(2) from None
    if plot is not None:
        draw_collisions(collisions).savefig(plot, dpi=110)
    if as_json:
        typer.echo(json.dumps([describe_contact(collision) for collision in collisions]))
        return
    Console().print(_build_table(law, collisions), highlight=False)


def describe_contact(contact: NamedTuple) -> dict[str, object]:
    """Convert numbers and fault of a contact, without its signals, to JSON; NaN is None."""
    scalars = {name: value for name, value in contact._asdict().items() if np.ndim(value) == 0}
    return {name: None if value != value else value for name, value in scalars.items()}


HEADINGS = ("mass [kg]", "speed [m/s]", "impact [N]", "peak [N]", "work [J]", "holding [N]")
"""Of the cells of `format_collision`."""


def format_collision(collision: Collision) -> list[str]:
    """Format mass, speed, forces and work."""
    missing = "no contact" if collision.fault is None else "fault"
    numbers = (
        collision.effective_mass_kg,
        collision.speed_m_per_s,
        collision.impact_n,
        collision.peak_n,
        collision.work_j,
        collision.holding_n,
    )
    return [f"{number:.3g}" if math.isfinite(number) else missing for number in numbers]


def _build_table(law: str, collisions: Sequence[Collision]) -> Table:
    table = Table(
        "σ [N·m/rad]", "direction", *HEADINGS, title=f"Collision with a wall: {get_title(law)}"
    )
    for collision in collisions:
        sign = "+x" if collision.direction > 0 else "−x"
        table.add_row(f"{collision.stiffness_nm_per_rad:g}", sign, *format_collision(collision))
    return table

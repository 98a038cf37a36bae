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

    from svsa.simulation.arm.tip_reference import TipMove
    from svsa.simulation.plant.loads.tip import Wall

STIFFNESSES_NM_PER_RAD = (10.0, 20.0, 40.0, 80.0, 140.0)
DIRECTIONS = (1, -1)
WALL_N_PER_M, DAMPING_NS_PER_M = 2000.0, 10.0
IMPACT_S, HOLDING_S = 0.03, 0.5
_REACH_M, _HEIGHT_M, _WALL_M = 0.2, -0.4, 0.1
_MOVE_S, _DURATION_S, _SHOWN_S = 1.2, 3.0, 1.0


class Collision(NamedTuple):
    """A collision of the tip with a wall.

    Attributes:
        stiffness_nm_per_rad: σ of both joints, N·m/rad.
        direction: 1 if the tip moves in the direction of x, −1 if it moves against it.
        speed_m_per_s: Speed towards the wall at the first contact. This and the following numbers
            are NaN without a contact.
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
    speed_m_per_s: float
    impact_n: float
    peak_n: float
    work_j: float
    holding_n: float
    fault: str | None
    time_s: np.ndarray
    force_n: np.ndarray
    depth_m: np.ndarray


def build_collision(
    direction: int, wall_n_per_m: float, damping_ns_per_m: float
) -> "tuple[TipMove, Wall]":
    """Build a straight movement of the tip by 0.4 m, and a wall 0.1 m before its end.

    Args:
        direction: 1 or −1, of the movement along x.
        wall_n_per_m: Contact stiffness of the wall, N/m.
        damping_ns_per_m: Contact damping of the wall, N·s/m.

    Returns:
        The movement and the wall.
    """
    from svsa.simulation.arm.tip_reference import TipMove
    from svsa.simulation.plant.loads.tip import Wall

    reach = direction * _REACH_M
    move = TipMove(start_m=(-reach, _HEIGHT_M), end_m=(reach, _HEIGHT_M), duration_s=_MOVE_S)
    return move, Wall(
        normal_rad=math.pi if direction > 0 else 0.0,
        distance_m=-_WALL_M,
        stiffness_n_per_m=wall_n_per_m,
        damping_ns_per_m=damping_ns_per_m,
    )


def measure_collision(
    law: str,
    stiffness: float,
    direction: int,
    wall_n_per_m: float = WALL_N_PER_M,
    damping_ns_per_m: float = DAMPING_NS_PER_M,
) -> Collision:
    """Simulate a collision in a horizontal plane, with exact models and arm feedforward.

    Without gravity and model errors the tip arrives at the wall with the same speed at every
    stiffness.

    Args:
        law: Name of the law of both joints.
        stiffness: σ of both joints, N·m/rad.
        direction: 1 or −1, of the movement along x.
        wall_n_per_m: Contact stiffness of the wall, N/m.
        damping_ns_per_m: Contact damping of the wall, N·s/m.

    Returns:
        Speed, forces, work and signals of the collision.
    """
    # Imported here: every command of `svsa` imports this file.
    from svsa.actuators.arm.parameters import RODS
    from svsa.runs.definition.arm_experiment import build_arm_experiment
    from svsa.runs.result.simulate_arm import simulate_arm

    move, wall = build_collision(direction, wall_n_per_m, damping_ns_per_m)
    joint = build_arm_experiment("rods", {}, {})
    exact = joint.actuator.changed(link_inertia_kg_m2=joint.nominal.link_inertia_kg_m2)
    run = simulate_arm(
        law=AnyLaw(law),
        duration_s=_DURATION_S,
        feedforward=True,
        tip=move,
        tip_loads=[wall],
        arm=RODS.changed(gravity_m_per_s2=0.0),
        stiffness=stiffness,
        nominal=dict(exact),
    )
    x = direction * run.tip_position_m[:, 0]
    force = -direction * run.wall_force_n[:, 0]
    period, fault = run.configuration.sampling.period_s, run.fault and run.fault.code
    if not np.any(force > 0.0):
        nan, empty = math.nan, np.empty(0)
        return Collision(stiffness, direction, nan, nan, nan, nan, nan, fault, empty, empty, empty)
    first = int(np.argmax(force > 0.0))
    time, pushed, done = run.time_s[first:] - run.time_s[first], force[first:], x[first:]
    work = np.cumsum(0.5 * (pushed[1:] + pushed[:-1]) * np.diff(done))
    return Collision(
        stiffness,
        direction,
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
        left.set_xlim(0.0, _SHOWN_S)
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
        typer.echo(json.dumps([_describe(collision) for collision in collisions]))
        return
    Console().print(_build_table(law, collisions), highlight=False)


def _describe(collision: Collision) -> dict[str, object]:
    """Convert numbers and fault of a collision, without its signals, to JSON; NaN is None."""
    scalars = {name: value for name, value in collision._asdict().items() if np.ndim(value) == 0}
    return {name: None if value != value else value for name, value in scalars.items()}


def _build_table(law: str, collisions: Sequence[Collision]) -> Table:
    heads = ("σ [N·m/rad]", "direction", "speed [m/s]", "impact [N]", "peak [N]", "work [J]")
    table = Table(*heads, "holding [N]", title=f"Collision with a wall: {get_title(law)}")
    for collision in collisions:
        numbers = (
            collision.speed_m_per_s,
            collision.impact_n,
            collision.peak_n,
            collision.work_j,
            collision.holding_n,
        )
        missing = "no contact" if collision.fault is None else "fault"
        cells = (f"{number:.3g}" if math.isfinite(number) else missing for number in numbers)
        sign = "+x" if collision.direction > 0 else "−x"
        table.add_row(f"{collision.stiffness_nm_per_rad:g}", sign, *cells)
    return table

"""`svsa arm-interaction`: what soft springs, soft control and both do in a contact.

Four controllers meet the same wall and the same hand. PD holds the motors, so that the link has the
stiffness σ of the spring; impedance control gives it K_d.
"""

import json
import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

import numpy as np
import typer
from rich.console import Console
from rich.table import Table

from svsa.evaluation.arm_collision import (
    DIRECTIONS,
    DURATION_S,
    HEADINGS,
    HOLDING_S,
    REACH_M,
    SHOWN_S,
    Collision,
    build_move,
    describe_contact,
    format_collision,
    measure_collision,
    simulate_horizontal,
)
from svsa.inputs.output_file import check_picture

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from svsa.runs.definition.design import Lane

SOFT_NM_PER_RAD, STIFF_NM_PER_RAD = 20.0, 140.0
DAMPING_NMS_PER_RAD = 1.0
PUSH_N, PUSH_BEGIN_S, PUSH_END_S = 2.0, 1.5, 2.5


class Controlled(NamedTuple):
    """A stiffness of the springs with a controller of both joints.

    Attributes:
        title: What is soft.
        stiffness_nm_per_rad: σ, N·m/rad.
        link_nm_per_rad: K_d of the impedance controller, N·m/rad; None for PD.
    """

    title: str
    stiffness_nm_per_rad: float
    link_nm_per_rad: float | None

    def build_lane(self) -> "Lane":
        """Build the law with its parameters."""
        from svsa.runs.definition.design import Lane

        if self.link_nm_per_rad is None:
            return Lane(law="pd")
        parameters = {
            "link_stiffness_nm_per_rad": self.link_nm_per_rad,
            "link_damping_nms_per_rad": DAMPING_NMS_PER_RAD,
        }
        return Lane(law="impedance", parameters=parameters)


CONTROLLED = (
    Controlled("neither is soft", STIFF_NM_PER_RAD, None),
    Controlled("soft spring", SOFT_NM_PER_RAD, None),
    Controlled("soft control", STIFF_NM_PER_RAD, SOFT_NM_PER_RAD),
    Controlled("both are soft", SOFT_NM_PER_RAD, SOFT_NM_PER_RAD),
)


class Push(NamedTuple):
    """A hand that pushes the resting tip with a constant force for a second.

    Attributes:
        direction: 1 if it pushes in the direction of x, −1 if against it.
        mean_displacement_m: Mean displacement of the tip in the last 0.5 s of the push, m, in its
            direction.
        stiffness_n_per_m: Force over mean displacement, N/m.
        expected_n_per_m: Stiffness of the tip with springs of σ or K_d in the joints, N/m, for a
            small force.
        work_j: Largest work of the hand, J.
        fault: Code of the fault that ended the run, or None; the numbers are NaN then.
        time_s: Time from the beginning of the push on, (samples,), s.
        displacement_m: Displacement of the tip, (samples,), m.
    """

    direction: int
    mean_displacement_m: float
    stiffness_n_per_m: float
    expected_n_per_m: float
    work_j: float
    fault: str | None
    time_s: np.ndarray
    displacement_m: np.ndarray


class Interaction(NamedTuple):
    """A controller at the wall and under the hand, in both directions."""

    controlled: Controlled
    collisions: tuple[Collision, ...]
    pushes: tuple[Push, ...]


def measure_push(controlled: Controlled, direction: int) -> Push:
    """Simulate the push of a hand at the end of the movement of `svsa arm-collision`.

    Args:
        controlled: Stiffness and controller.
        direction: 1 or −1, of movement and push along x.

    Returns:
        Displacement, stiffness and work.
    """
    # Imported here: every command of `svsa` imports this file.
    from svsa.actuators.arm.tip_stiffness import compute_tip_stiffness
    from svsa.simulation.plant.loads.tip import TipForce

    hand = TipForce(
        force_n=(direction * PUSH_N, 0.0),
        start_s=PUSH_BEGIN_S,
        duration_s=PUSH_END_S - PUSH_BEGIN_S,
    )
    lane, sigma = controlled.build_lane(), controlled.stiffness_nm_per_rad
    run = simulate_horizontal(lane, sigma, build_move(direction), hand)
    period, fault = run.configuration.sampling.period_s, run.fault and run.fault.code
    first = round(PUSH_BEGIN_S / period)
    displacement = direction * run.tip_position_m[first:, 0] - REACH_M
    time = run.time_s[first:] - PUSH_BEGIN_S
    if fault is not None:
        nan = math.nan
        return Push(direction, nan, nan, nan, nan, fault, time, displacement)
    pushed = displacement[time <= PUSH_END_S - PUSH_BEGIN_S]
    mean = float(pushed[-round(HOLDING_S / period) :].mean())
    q = np.array([[joint["position_reference_rad"][first] for joint in run.joints]])
    joint = np.full_like(q, controlled.link_nm_per_rad or sigma)
    lengths = np.array([link.length_m for link in run.configuration.require_arm().links.chain])
    compliance = np.linalg.inv(compute_tip_stiffness(lengths, q, joint)[0])
    expected, work = 1.0 / float(compliance[0, 0]), PUSH_N * float(pushed.max())
    return Push(direction, mean, PUSH_N / mean, expected, work, None, time, displacement)


def measure_interactions() -> list[Interaction]:
    """Simulate wall and hand with each of `CONTROLLED`, in both directions."""
    interactions = []
    for controlled in CONTROLLED:
        lane, sigma = controlled.build_lane(), controlled.stiffness_nm_per_rad
        collisions = tuple(measure_collision(lane, sigma, direction) for direction in DIRECTIONS)
        pushes = tuple(measure_push(controlled, direction) for direction in DIRECTIONS)
        interactions.append(Interaction(controlled, collisions, pushes))
    return interactions


def draw_interactions(interactions: Sequence[Interaction]) -> "Figure":
    """Draw force of the wall and displacement by the hand over time, a row per direction; needs the
    extra `plot`.
    """
    from matplotlib.figure import Figure

    from svsa.runs.result.plot import label_axes

    figure = Figure(figsize=(9.0, 2.9 * len(DIRECTIONS)), layout="constrained")
    grid = figure.subplots(len(DIRECTIONS), 2, sharex="col", sharey="col", squeeze=False)
    for row, ((left, right), direction) in enumerate(zip(grid, DIRECTIONS, strict=True)):
        for number, (controlled, collisions, pushes) in enumerate(interactions):
            style = {"color": f"C{number}", "linewidth": 1.2}
            left.plot(collisions[row].time_s, collisions[row].force_n, **style)
            (curve,) = right.plot(pushes[row].time_s, 1e3 * pushes[row].displacement_m, **style)
            if row == 0:
                curve.set_label(_name(controlled))
        sign = "+" if direction > 0 else "−"
        label_axes(left, f"Force of the wall, {sign}x [N]")
        label_axes(right, f"Displacement by the hand, {sign}x [mm]")
        left.set_xlim(0.0, SHOWN_S)
        right.set_xlim(0.0, DURATION_S - PUSH_BEGIN_S)
    grid[-1][0].set_xlabel("Time from the first contact [s]")
    grid[-1][1].set_xlabel("Time from the push [s]")
    grid[0][1].legend(fontsize="small", frameon=False)
    return figure


def _name(controlled: Controlled) -> str:
    law = "PD" if controlled.link_nm_per_rad is None else f"K_d = {controlled.link_nm_per_rad:g}"
    return f"{controlled.title}: σ = {controlled.stiffness_nm_per_rad:g}, {law}"


def arm_interaction(
    plot: Annotated[Path | None, typer.Option(help="Picture file (.png, .pdf, .svg).")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
) -> None:
    """Let a soft spring, soft control and both meet a wall and a hand, in both directions."""
    check_picture("--plot", plot)
    interactions = measure_interactions()
    if plot is not None:
        draw_interactions(interactions).savefig(plot, dpi=110)
    if as_json:
        typer.echo(json.dumps([_describe(interaction) for interaction in interactions]))
        return
    console = Console()
    for table in _build_tables(interactions):
        console.print(table, highlight=False)


def _describe(interaction: Interaction) -> dict[str, Any]:
    """Convert the numbers and faults, without the signals, to JSON; NaN is None."""
    return {
        **interaction.controlled._asdict(),
        "collisions": [describe_contact(collision) for collision in interaction.collisions],
        "pushes": [describe_contact(push) for push in interaction.pushes],
    }


def _build_tables(interactions: Sequence[Interaction]) -> tuple[Table, Table]:
    wall = Table("controller", "direction", *HEADINGS, title="Wall")
    heads = ("displacement [mm]", "stiffness [N/m]", "expected [N/m]", "work [J]")
    hand = Table("controller", "direction", *heads, title=f"Hand, {PUSH_N:g} N")
    for controlled, collisions, pushes in interactions:
        name = _name(controlled)
        for collision in collisions:
            wall.add_row(name, _sign(collision.direction), *format_collision(collision))
        for push in pushes:
            displacement_mm = 1e3 * push.mean_displacement_m
            numbers = displacement_mm, push.stiffness_n_per_m, push.expected_n_per_m, push.work_j
            cells = ("fault" if push.fault else f"{number:.3g}" for number in numbers)
            hand.add_row(name, _sign(push.direction), *cells)
    return wall, hand


def _sign(direction: int) -> str:
    return "+x" if direction > 0 else "−x"

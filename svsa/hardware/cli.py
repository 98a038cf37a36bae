"""`svsa bench-check` and `svsa bench-home`: test and zero a bench."""

import contextlib
import getpass
import signal
from collections.abc import Iterator
from pathlib import Path
from types import FrameType
from typing import Annotated, NoReturn

import typer
from rich.console import Console
from rich.padding import Padding
from rich.text import Text

from svsa.inputs.extras import require_extra
from svsa.inputs.terminal import INTERRUPTED

_COLOURS = {"ok": "green", "warn": "yellow", "fail": "bold red"}
_MOVE_WARNING = (
    "--move turns first the principal motor, then the stiffness motor, by short pulses of current"
    " (a few degrees, forth and back). Hand on the emergency stop, all persons clear of the link,"
    " nothing hung on it, both motors away from their ends. Watch which way each turns FIRST."
)

BenchPath = Annotated[Path, typer.Argument(help="Bench file (TOML).")]


def bench_check(
    file: BenchPath,
    move: Annotated[
        bool,
        typer.Option(
            "--move", help="Also move both motors slightly, to check signs, scales and latency."
        ),
    ] = False,
    yes: Annotated[
        bool,
        typer.Option("--yes", help="Move without confirmation, and do not ask for the directions."),
    ] = False,
) -> None:
    """Test a bench step by step: file, bus, drives, encoders; with --move signs and scales."""
    require_extra("bench")
    from svsa.hardware.commissioning import check_bench
    from svsa.hardware.commissioning.step import Result

    console = Console(highlight=False)
    if move and not yes:
        console.print(_MOVE_WARNING, style="bold")
        typer.confirm("May the motors move?", abort=True)
    watch = None if yes else typer.confirm
    failed = False
    try:
        with (
            _interrupted_once(),
            contextlib.closing(check_bench(file, move, watch)) as steps,
        ):
            for step in steps:
                failed = failed or step.result is Result.FAIL
                colour = _COLOURS[step.result]
                console.print(f"[{colour}]{step.result:>4}[/]  [bold]{step.name}[/]")
                console.print(Padding(Text(step.measured), (0, 0, 0, 6)))
                if step.advice:
                    advice = Text(f"→ {step.advice}", colour)
                    console.print(Padding(advice, (0, 0, 0, 6)))
    except (KeyboardInterrupt, typer.Abort):
        console.print("Interrupted: the drives that were used are at zero current and reset.")
        raise typer.Exit(INTERRUPTED) from None
    if failed:
        raise typer.Exit(1)


def bench_home(
    file: BenchPath,
    by: Annotated[
        str | None,
        typer.Option(
            help="Name of the user who checks the marks; default: the command asks for it."
        ),
    ] = None,
) -> None:
    """Write the calibration record of a bench: zero counts, and who checked the zero marks."""
    require_extra("bench")
    from svsa.hardware.bench.homing import STEPS, Homing
    from svsa.hardware.commissioning.zero import calibrate
    from svsa.hardware.description.calibration import list_problems
    from svsa.hardware.description.file import read_bench

    console = Console(highlight=False)
    bench = read_bench(file)
    name = by or typer.prompt("Your name", default=getpass.getuser())
    homing = Homing()
    console.print(f"{bench.name}: drives off or without current, the mechanism by hand.")
    for step in STEPS:
        typer.confirm(f"{step.instruction} Is it there?", abort=True)
        homing.confirm(step.name, name)
    path, calibration = calibrate(bench, homing)
    console.print(
        f"{path}: deflection zero at {calibration.deflection_zero_counts} counts, confirmed by"
        f" {calibration.by}.",
        markup=False,
    )
    for problem in list_problems(bench, calibration):
        console.print(f"Still missing: {problem}.", markup=False)


@contextlib.contextmanager
def _interrupted_once() -> Iterator[None]:
    """Handle SIGTERM like Ctrl-C, so that the bench is left in the same state.

    A second Ctrl-C does not interrupt the ramp-down of the currents.
    """

    def interrupt(number: int, frame: FrameType | None) -> NoReturn:
        for each in numbers:
            signal.signal(each, signal.SIG_IGN)
        raise KeyboardInterrupt

    numbers = (signal.SIGINT, signal.SIGTERM)
    before = [signal.signal(number, interrupt) for number in numbers]
    try:
        yield
    finally:
        for number, handler in zip(numbers, before, strict=True):
            signal.signal(number, handler)

"""The `svsa` command.

Other packages add commands through the entry point group `svsa.commands` (the server adds `serve`
and `openapi`), so that the library does not depend on them.
"""

import json
import signal
import sys
from collections.abc import Iterable, Sequence
from importlib.metadata import entry_points
from pathlib import Path
from types import FrameType
from typing import Annotated, Any

import typer
from rich.console import Console
from rich.markup import escape
from rich.progress import Progress
from rich.table import Table
from typer.core import TyperGroup

import svsa
from svsa.actuators.installed import get_mechanism
from svsa.actuators.parameters import SVSA
from svsa.analysis.datasheet.cli import datasheet
from svsa.analysis.design.cli import margins, stability
from svsa.analysis.exchange.cli import export_model
from svsa.analysis.identification.cli import identify
from svsa.errors import SvsaError
from svsa.evaluation.arm_collision import arm_collision
from svsa.evaluation.arm_interaction import arm_interaction
from svsa.evaluation.arm_map import arm_map
from svsa.evaluation.falsifier.cli import falsify
from svsa.evaluation.ranking.arm_cli import rank_arm
from svsa.evaluation.ranking.bench_cli import bench as ranking_bench
from svsa.evaluation.ranking.cli import ranking
from svsa.evaluation.spring_trials import spring_trials
from svsa.evaluation.studies.cli import study
from svsa.evaluation.tuning.cli import tune
from svsa.hardware.cli import bench_check, bench_home
from svsa.hardware.emulator.cli import emulator
from svsa.inputs.data_folder import find_data_folder
from svsa.inputs.extras import require_extra
from svsa.inputs.terminal import spell_missing_characters
from svsa.numerics.compilation import is_compiled_before
from svsa.runs.result.cli import compare
from svsa.runs.result.progress import hide_progress
from svsa.teaching.course.cli import course
from svsa.teaching.grading.cli import grade_command
from svsa.teaching.leaderboard.cli import leaderboard_command, submit_command


class _Commands(TyperGroup):
    def invoke(self, ctx: Any) -> Any:
        try:
            return super().invoke(ctx)
        except EOFError as error:  # for which click prints only "Aborted."
            raise RuntimeError(f"Unexpected end of a file or of the input: {error}.") from error


app = typer.Typer(
    cls=_Commands,
    no_args_is_help=True,
    pretty_exceptions_enable=False,
)
_messages = Console(stderr=True)
PAPERS_LAWS = ("fl", "ndobc")


def _print_version(is_requested: bool) -> None:
    if is_requested:
        print(svsa.__version__)
        raise typer.Exit


@app.callback()
def describe(
    version: Annotated[
        bool,
        typer.Option(
            "--version", help="Print the version and exit.", callback=_print_version, is_eager=True
        ),
    ] = False,
) -> None:
    """SVSA Lab: position and stiffness control of a serial variable stiffness actuator."""


@app.command()
def reproduce(
    figure: Annotated[
        list[str] | None,
        typer.Option(help="4a, 4b, 5 (default: all three), or 6a, 6b, 7 on the emulator."),
    ] = None,
    output: Annotated[Path, typer.Option(help="Folder for the pictures.")] = Path("figures"),
    as_json: Annotated[
        bool, typer.Option("--json", help="Print the numbers without pictures.")
    ] = False,
) -> None:
    """Reproduce the paper's figures 4A, 4B, 5 (simulated) or 6A, 6B, 7 (emulated bench)."""
    from svsa.evaluation.reproduction import reproduce as run_figures
    from svsa.runs.definition.paper import FIGURES

    if not as_json:
        require_extra("plot")
    prepare(PAPERS_LAWS)
    with Progress(console=_messages, transient=True) as bar:
        task = bar.add_task("Running the figures", total=1.0)
        keys = tuple(figure) if figure else tuple(FIGURES)
        runs = run_figures(keys, lambda done: bar.update(task, completed=done))
    if as_json:
        rows = [{"figure": run.figure, "controller": run.law, **run.numbers} for run in runs]
        print(json.dumps({"runs": rows}, indent=2))
        return
    from svsa.evaluation.reproduction_tables import build_tables

    Console().print(*build_tables(runs))
    from svsa.evaluation.reproduction_pictures import save_figures

    with _messages.status("Drawing …"):
        paths = save_figures(runs, output)
    Console().print("Pictures: " + ", ".join(str(path) for path in paths))


ranking.command("bench")(ranking_bench)
ranking.command("arm")(rank_arm)
ranking.command("submit")(submit_command)
ranking.command("leaderboard")(leaderboard_command)
app.add_typer(ranking, name="ranking")
app.command("tune")(tune)
app.add_typer(study, name="study")
app.add_typer(falsify, name="falsify")
app.add_typer(course, name="course")
app.command("grade")(grade_command)
app.command("compare")(compare)
app.command("emulator")(emulator)
app.command("identify")(identify)
app.command("stability")(stability)
app.command("margins")(margins)
app.command("datasheet")(datasheet)
app.command("export-model")(export_model)
app.command("arm-map")(arm_map)
app.command("arm-collision")(arm_collision)
app.command("arm-interaction")(arm_interaction)
app.command("spring-trials")(spring_trials)
app.command("bench-check")(bench_check)
app.command("bench-home")(bench_home)


@app.command("benchmark")
def measure_costs(
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
    repeats: Annotated[int, typer.Option(min=1, help="Number of measurements of each value.")] = 15,
    laws: Annotated[
        bool, typer.Option("--laws", help="Measure only a tick under each law.")
    ] = False,
    start: Annotated[
        bool, typer.Option(help="Also measure the compilation (about a minute).")
    ] = True,
) -> None:
    """Measure the CPU time of the loop, and of a C loop that does the same work."""
    from svsa.evaluation.timing.bench_tick import TickCost, measure_laws
    from svsa.evaluation.timing.benchmark import measure, measure_start

    prepare(None if laws else PAPERS_LAWS)
    with _messages.status("Measuring …"):
        ticks = measure_laws(repeats) if laws else {}
        costs: dict[str, Any] = (
            {} if laws else measure(repeats) | (measure_start() if start else {})
        )
    if not laws and costs["ratio_to_c"] is None:
        _messages.print(
            "No C loop to compare with: it needs a C compiler (cc) and tests/benchmarks/loop.c of"
            " the source tree, which an installed package does not contain. Ratios are null."
        )
    if as_json:
        each = {law: cost._asdict() for law, cost in ticks.items()}
        print(json.dumps(each or costs, indent=2))
        return
    heads = ("law", *TickCost._fields) if laws else ("what", "cost")
    table = Table(*heads, title="Time of a tick" if laws else "CPU time, minimum of many")
    for law, cost in ticks.items():
        table.add_row(law, *(f"{value:.4g}" for value in cost))
    by_effects = costs.pop("runs_per_second_1_core_by_effects", {})
    costs |= {f"runs_per_second_1_core: {name}": rate for name, rate in by_effects.items()}
    by_actuator = costs.pop("actuator_ratio_to_kernel", {})
    costs |= {f"actuator_ratio_to_kernel: {name}": ratio for name, ratio in by_actuator.items()}
    for name, solver in costs.pop("solvers", {}).items():
        costs |= {f"solver {name}: {key}": value for key, value in solver.items()}
    for name, value in costs.items():
        table.add_row(name, f"{value:.4g}" if isinstance(value, float) else str(value))
    Console().print(table)


@app.command("bench-dbc")
def print_dbc(file: Annotated[Path, typer.Argument(help="Bench file (TOML).")]) -> None:
    """Print the frames of a bench as a DBC file, which CAN tools read to decode a capture."""
    require_extra("bench")
    from svsa.hardware.description.dbc import describe_bench
    from svsa.hardware.description.file import read_bench

    print(describe_bench(read_bench(file)))


@app.command("backup")
def write_backup(
    archive: Annotated[Path, typer.Argument(help="File to write, such as lab.tar.gz.")],
) -> None:
    """Write the data folder (runs, studies, class, grades) to an archive; the lab can run."""
    from svsa.runs.records.backup import back_up

    folder = find_data_folder()
    with _messages.status(f"Copying {folder} …"):
        number = back_up(folder, archive)
    print(f"{archive}: {number} files of {folder}. It contains the secrets of a class.")


@app.command("restore")
def restore_backup(
    archive: Annotated[Path, typer.Argument(help="Archive of `svsa backup`.")],
) -> None:
    """Extract an archive of `svsa backup` into the data folder, which must be empty."""
    from svsa.runs.records.backup import restore

    folder = find_data_folder()
    with _messages.status(f"Extracting to {folder} …"):
        version = restore(archive, folder)
    print(f"{folder}: restored from an archive of svsa {version}.")


@app.command("compile")
def compile_loop(
    laws: Annotated[
        list[str] | None, typer.Argument(help="Names of laws; default: all installed laws.")
    ] = None,
    actuator: Annotated[
        str,
        typer.Option(
            help="Installed actuator. All actuators except the SVSA share one compiled loop."
        ),
    ] = SVSA,
    arm: Annotated[
        str | None,
        typer.Option(help="Also compile an arm: the actuators of its joints, such as svsa,qbmove."),
    ] = None,
) -> None:
    """Compile the control loop into the cache, so that later starts are quick."""
    joints = tuple(arm.split(",")) if arm else ()
    for name in (actuator, *joints):
        get_mechanism(name)  # an unknown name is rejected before anything is compiled
    prepare(laws, actuator, joints)


def prepare(
    laws: Iterable[str] | None = None, actuator: str = SVSA, arm: Sequence[str] = ()
) -> None:
    """Compile the control loop, metrics and these laws, and report a long compilation.

    `laws` are all installed laws by default. A law that does not work is reported, and the others
    are compiled.
    The loop of the SVSA and that of all other actuators, `actuator`, are compiled separately, and
    so is that of an arm with these actuators in its joints.
    """
    from svsa.control.installed import LawError, list_law_names
    from svsa.control.law_names import AnyLaw
    from svsa.numerics.exponential import exp
    from svsa.runs.definition.arm_experiment import build_actuated_arm
    from svsa.runs.definition.experiment import build_actuator_experiment
    from svsa.runs.result.simulate import simulate
    from svsa.runs.result.simulate_arm import simulate_arm
    from svsa.simulation.loop.loop import advance

    names = list_law_names() if laws is None else tuple(laws)
    if is_compiled_before(advance):
        text = "Loading the compiled control loop …"
    else:
        law = "1 law" if len(names) == 1 else f"{len(names)} laws"
        text = f"First start: compiling the control loop (about 10 s, once) and {law} (3 s each) …"
        _messages.print(text)
    with _messages.status(text):
        exp(0.0)  # of the state estimator, which a user may add to a running session
        for name in names:
            try:
                experiment = "4a" if actuator == SVSA else build_actuator_experiment(actuator, name)
                simulate(experiment, AnyLaw(name), duration_s=0.01).measure(0.0, 0.01)
                if arm:
                    simulate_arm(build_actuated_arm("rods", arm), AnyLaw(name), duration_s=0.01)
            except LawError as error:
                _messages.print(f"[bold red]{escape(str(error))}[/]", highlight=False)


def main() -> None:
    """Entry point: errors of this project and Ctrl-C are one clear line, not a traceback."""
    is_interrupted = False

    def interrupt(number: int, frame: FrameType | None) -> None:
        nonlocal is_interrupted
        is_interrupted = True
        # Partly constructed objects print "Exception ignored" when they are deleted.
        sys.unraisablehook = lambda _: None
        signal.default_int_handler(number, frame)

    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, interrupt)
    try:
        spell_missing_characters()
        for entry in entry_points(group="svsa.commands"):
            app.command(entry.name)(entry.load())
        hide_progress()  # of single runs: the commands have bars
        app()
    except (SvsaError, OSError) as error:
        _messages.print(f"[bold red]Error:[/] {escape(str(error))}", highlight=False)
        raise SystemExit(1) from None
    except SystemExit as ended:
        if ended.__context__ and isinstance(ended.__context__.__cause__, KeyboardInterrupt):
            _messages.print("Interrupted.")  # typer exits with 130 without a message
        raise
    except BaseException:
        if not is_interrupted:
            raise
        # Or an error that follows: C code discards the exception of a callback, as in the compiler.
        _messages.print("Interrupted.")
        raise SystemExit(130) from None

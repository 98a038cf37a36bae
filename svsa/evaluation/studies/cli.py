"""`svsa study`: run, list, summarize, compare and replay studies."""

import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer
from rich.console import Console
from rich.table import Table

from svsa.errors import ParameterError, Violation
from svsa.evaluation.progress_bar import Report, show_progress
from svsa.inputs.extras import require_extra
from svsa.inputs.terminal import INTERRUPTED

if TYPE_CHECKING:
    from svsa.evaluation.studies.stored import StoredStudy
    from svsa.evaluation.studies.study import Study

study = typer.Typer(
    no_args_is_help=True, help="Run many perturbed runs of each law, and show their statistics."
)
_messages = Console(stderr=True)


@study.command("run")
def run_command(
    source: Annotated[
        str,
        typer.Argument(
            metavar="STUDY", help="A file (.toml or .py), or the name of a saved or built-in study."
        ),
    ],
    runs: Annotated[
        int | None, typer.Option(min=1, help="Number of samples; default: the number of the study.")
    ] = None,
    name: Annotated[
        str | None,
        typer.Option(help="Name to save the study under; default: the name of the file."),
    ] = None,
    workers: Annotated[
        int | None,
        typer.Option(
            min=1,
            max=256,
            help="Number of processes on this machine, with low priority; default: 2.",
        ),
    ] = None,
    scheduler: Annotated[
        str | None,
        typer.Option(
            metavar="ADDRESS",
            help="Scheduler of a Dask cluster, such as tcp://10.0.0.1:8786; `local`: a cluster of"
            " --workers processes on this machine.",
        ),
    ] = None,
) -> None:
    """Run or continue a study. Ctrl-C keeps the finished part."""
    from svsa.evaluation.studies.rows import count_done
    from svsa.evaluation.studies.store import keep_study

    if scheduler is not None:
        _check_cluster(scheduler, workers)
    known, read = _find_study(source, runs)
    stored = keep_study(name or known, read)
    begun = time.monotonic()
    with show_progress(_messages, stored.name, stored.study.row_count) as report:
        done = _run(stored, workers, scheduler, report)
    rows = count_done(stored) * len(stored.study.laws)
    progress = f"{rows} of {stored.study.row_count} runs of study {stored.name} are done"
    _messages.print(f"{progress} ({time.monotonic() - begun:.0f} s this time): {stored.folder}")
    if not done:
        again = _describe_repeat(source, runs=runs, name=name, workers=workers, scheduler=scheduler)
        _messages.print(f"Continue with: svsa study run {again}")
        raise typer.Exit(INTERRUPTED)
    _messages.print(f"Results: svsa study show {stored.name}")


def _find_study(source: str, runs: int | None) -> "tuple[str, Study]":
    """Find the study to run: a file, a built-in one, or a saved one of this name."""
    from svsa.evaluation.studies.file import find_study_file, read_study
    from svsa.evaluation.studies.store import is_kept, open_study

    if find_study_file(source) is None and is_kept(source):
        kept = open_study(source).study
        return source, kept if runs is None else kept.changed(runs=runs)
    return read_study(source, runs)


def _check_cluster(scheduler: str, workers: int | None) -> None:
    """Check that Dask is installed, and that --workers is given for a local cluster only."""
    require_extra("cluster")
    from svsa.evaluation.studies.cluster import LOCAL

    if workers is not None and scheduler != LOCAL:
        bound = f"omitted: the cluster at {scheduler} has its own workers"
        raise ParameterError(Violation("--workers", workers, "", bound))


def _run(stored: "StoredStudy", workers: int | None, scheduler: str | None, report: Report) -> bool:
    """Run the missing part, here or on a cluster; return whether the study is complete."""
    from svsa.evaluation.studies.execution import WORKERS, run_study

    def progress(done: int, total: int) -> None:
        report(done, "")

    if scheduler is None:
        return run_study(stored, workers or WORKERS, progress=progress)
    from svsa.evaluation.studies.cluster import open_cluster

    with open_cluster(scheduler, workers or WORKERS) as cluster:
        rows_per_part = cluster.choose_rows_per_part(stored.study.row_count)
        return run_study(stored, 0, rows_per_part, progress, run_parts=cluster.run_parts)


def _describe_repeat(source: str, **options: object) -> str:
    arguments = [f"--{name} {value}" for name, value in options.items() if value is not None]
    return " ".join([source, *arguments])


@study.command("list")
def list_command() -> None:
    """List the built-in and the saved studies."""
    from svsa.evaluation.studies.file import list_built_in
    from svsa.evaluation.studies.rows import count_done
    from svsa.evaluation.studies.store import list_studies

    table = Table("study", "about", "runs done", title="Studies", title_justify="left")
    for stored in list_studies():
        laws = len(stored.study.laws)
        done = f"{count_done(stored) * laws} of {stored.study.row_count}"
        table.add_row(stored.name, stored.study.title, done)
    begun = {stored.name for stored in list_studies()}
    for name, title in list_built_in().items():
        if name not in begun:
            table.add_row(name, title, "built in, not begun")
    Console().print(table)


@study.command("show")
def show_command(
    name: Annotated[str, typer.Argument(metavar="STUDY", help="Name of a saved study.")],
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
    outcome: Annotated[
        str | None,
        typer.Option(help="Outcome of the Sobol indices: succeeded (default), or a metric."),
    ] = None,
    pictures: Annotated[Path | None, typer.Option(help="Draw pictures into this folder.")] = None,
) -> None:
    """Show the results of a study: success, faults and quantiles of each law, and Sobol indices.

    If the actuator varies, the results of each actuator are shown first, then those of all.
    """
    from svsa.evaluation.studies.rows import read_rows
    from svsa.evaluation.studies.store import open_study
    from svsa.evaluation.studies.summary import (
        SUCCEEDED,
        estimate_sensitivity,
        summarize_actuators,
        summarize_laws,
    )
    from svsa.evaluation.studies.tables import (
        build_sensitivity_table,
        build_summary_tables,
        write_json,
    )

    if pictures is not None:
        require_extra("plot")
    stored = open_study(name)
    rows = read_rows(stored)
    laws = summarize_laws(stored.study, rows)
    actuators = summarize_actuators(stored.study, rows)
    is_asked = outcome is not None or stored.study.sampling == "sensitivity"
    indices = [
        estimate_sensitivity(stored.study, rows, law, outcome or SUCCEEDED)
        for law in (stored.study.laws if is_asked else ())
    ]
    if as_json:
        write_json({"study": name, "laws": laws, "actuators": actuators, "sensitivity": indices})
    else:
        for actuator, summaries in actuators.items():
            Console().print(*build_summary_tables(stored.study, summaries, actuator))
        Console().print(*build_summary_tables(stored.study, laws))
        for sensitivity in indices:
            Console().print(build_sensitivity_table(sensitivity))
    if pictures is not None:
        from svsa.evaluation.studies.pictures import save_pictures

        paths = save_pictures(stored, rows, indices, pictures)
        _messages.print("Pictures: " + ", ".join(str(path) for path in paths))


@study.command("compare")
def compare_command(
    name: Annotated[str, typer.Argument(metavar="STUDY", help="Name of a saved study.")],
    other: Annotated[
        str | None,
        typer.Argument(
            metavar="OTHER",
            help="Another study with the same samples; default: compare the laws of the study.",
        ),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
) -> None:
    """Compare laws on the same samples, or the same laws in two studies."""
    from svsa.evaluation.studies.rows import read_rows
    from svsa.evaluation.studies.store import open_study
    from svsa.evaluation.studies.summary import compare_laws, pair_studies
    from svsa.evaluation.studies.tables import build_pairing_table, write_json

    stored = open_study(name)
    if other is not None:
        pairings = pair_studies(stored, open_study(other))
    else:
        pairings = compare_laws(stored.study, read_rows(stored))
    if as_json:
        write_json({"pairings": pairings})
    elif not pairings:
        _messages.print(f"Study {name} has one law only: name another study with the same samples.")
    else:
        for pairing in pairings:
            Console().print(build_pairing_table(pairing))


@study.command("replay")
def replay_command(
    name: Annotated[str, typer.Argument(metavar="STUDY", help="Name of a saved study.")],
    row: Annotated[int, typer.Argument(help="Number of the row in its table, from 0.")],
    keep: Annotated[bool, typer.Option(help="Save it as a recorded run.")] = True,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
) -> None:
    """Run one row of a study again, with all its samples, as a recorded run."""
    from svsa.evaluation.metrics import METRICS
    from svsa.evaluation.studies.replay import record_replay, replay_row
    from svsa.evaluation.studies.store import open_study
    from svsa.evaluation.studies.tables import format_metric, write_json
    from svsa.runs.records.catalogue.runs import Catalogue

    stored = open_study(name)
    replay = replay_row(stored, row)
    run_id = record_replay(stored, replay, Catalogue()).id if keep else None
    if as_json:
        report = {"row": row, "run_id": run_id, "metrics": replay.metrics}
        write_json(report | {"identical": not replay.differing, "differing": replay.differing})
    else:
        table = Table("metric", "unit", "table", "replay", title_justify="left")
        table.title = f"Row {row} of study {name}: {replay.kept['law']}"
        for metric in stored.study.metrics:
            values = f"{replay.kept[metric]!r}", f"{replay.metrics[metric]!r}"
            table.add_row(format_metric(metric), METRICS[metric], *values)
        Console().print(table)
        ended = replay.result.fault
        _messages.print(ended.message if ended else "The run was completed.")
        if run_id is not None:
            _messages.print(f"Recorded as run {run_id}, with 3D on the page Runs of the lab.")
    if replay.differing:
        _messages.print(
            f"[bold red]Not bit-identical: {', '.join(replay.differing)}[/]. The study was"
            f" run by version {stored.version} of svsa."
        )
        raise typer.Exit(1)

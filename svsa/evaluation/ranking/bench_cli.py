"""`svsa ranking bench`: laws in the paper's bench figures on the emulator, next to a baseline."""

import json
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from svsa.control.installed import PAPERS_LAW, check_installed, list_law_names
from svsa.errors import ParameterError, Violation
from svsa.evaluation.campaign.results_file import write_results_file
from svsa.evaluation.progress_bar import show_progress
from svsa.evaluation.ranking.bench_runs import BenchRuns, read_bench_runs
from svsa.evaluation.ranking.bench_table import build_table, format_bench
from svsa.evaluation.ranking.measure_bench import measure_on_bench
from svsa.runs.definition.paper import BENCH_FIGURES

MIN_WIDTH = 132
"""Width of the terminal, in characters, that shows the table's numbers without wrapping."""


def bench(
    laws: Annotated[
        list[str] | None, typer.Argument(help="Names of laws; default: all installed laws.")
    ] = None,
    comparison: Annotated[str, typer.Option(help="Name of the law to compare with.")] = PAPERS_LAW,
    figure: Annotated[
        list[str] | None, typer.Option(help="6a, 6b or 7; repeatable; default: all three.")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
    markdown: Annotated[bool, typer.Option("--markdown", help="Print Markdown.")] = False,
    save: Annotated[
        Path | None, typer.Option(help="Save the runs in this file; the file keeps its other laws.")
    ] = None,
    results: Annotated[
        Path | None, typer.Option(help="Show the results of this file, without a measurement.")
    ] = None,
) -> None:
    """Run laws in Figures 6A, 6B and 7 on the emulator, and compare 12 numbers with a baseline."""
    kept = read_bench_runs(save) if save is not None and save.exists() else None
    figures = tuple(dict.fromkeys(_check_figure(key) for key in figure or BENCH_FIGURES))
    if results is None:
        names = [check_installed(name) for name in laws or list_law_names()]
        runs = _measure(tuple(dict.fromkeys([check_installed(comparison), *names])), figures)
    else:
        shown = read_bench_runs(results)
        runs = shown.choose(tuple(dict.fromkeys([comparison, *(laws or shown.laws)])))
        runs = runs.changed(runs=tuple(run for run in runs.runs if run.figure in figures))
    if save is not None:
        write_results_file(save, kept.renew(runs) if kept else runs)
    if as_json:
        print(json.dumps(runs.to_json(comparison), indent=2))
    elif markdown:
        print(format_bench(runs, comparison))
    else:
        screen = Console()
        Console(width=max(screen.width, MIN_WIDTH)).print(build_table(runs, comparison))


def _check_figure(key: str) -> str:
    if key.lower() not in BENCH_FIGURES:
        raise ParameterError(Violation("figure", key, "", "one of " + ", ".join(BENCH_FIGURES)))
    return key.lower()


def _measure(laws: tuple[str, ...], figures: tuple[str, ...]) -> BenchRuns:
    runs = len(laws) * len(figures)
    with show_progress(Console(stderr=True), "Runs of 20 s through CAN", runs, "") as report:
        return measure_on_bench(laws, figures, lambda share: report(share * runs))

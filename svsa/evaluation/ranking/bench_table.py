"""The results in the paper's bench figures as text, for the terminal and the laws' pages."""

from rich.box import SIMPLE_HEAD
from rich.table import Table
from rich.text import Text

from svsa.actuators.faults import label_fault
from svsa.control.installed import PAPERS_LAW, get_title
from svsa.evaluation.ranking.bench_runs import NUMBERS, BenchRun, BenchRuns

SHORT = dict(zip(NUMBERS, ("before", "peak", "settled", "recov."), strict=True))
LONG = dict(zip(NUMBERS, ("rms 1–5 s", "peak", "rms 8–20 s", "recovery"), strict=True))


def format_run_number(run: BenchRun, number: str, unit: bool = True) -> str:
    """Format a number of a run, in degrees or seconds.

    Args:
        run: The run of a law in a figure.
        number: A field of `RecoveryErrors`.
        unit: Whether to append the unit.

    Returns:
        Three digits; "fault" after a fault, "never" if the error does not settle.
    """
    value: float | None = getattr(run.errors, number)
    if value is None:
        return "fault" if run.fault else "never"
    return f"{value:.3g}{(' s' if number == 'recovery_s' else '°') if unit else ''}"


def build_table(runs: BenchRuns, comparison: str) -> Table:
    """Build a table with one row per law; bold: not worse than the baseline."""
    figures = [run.figure for run in runs.list_runs(comparison)]
    table = Table(
        box=SIMPLE_HEAD,
        padding=(0, 1, 0, 0),
        title="Position errors [°] as the emulator measures them, through CAN",
        title_justify="left",
        caption=f"Before: rms 1–5 s; peak 5–7 s; settled: rms 8–20 s; recov.: s. No worse: in how"
        f" many numbers than {get_title(comparison)}, in bold. Load: 2 N·m on the link from 5 s.",
        caption_justify="left",
    )
    table.add_column("law", no_wrap=True)
    for figure in figures:
        for heading in SHORT.values():
            table.add_column(f"{figure.upper()}\n{heading}", justify="right", no_wrap=True)
    table.add_column("no worse", justify="right", no_wrap=True)
    for law in runs.laws:
        cells = {
            (mine.figure, number): _build_cell(mine, other, number)
            for mine, other in runs.pair(law, comparison)
            for number in NUMBERS
        }
        row = [cells.get((figure, number), "") for figure in figures for number in NUMBERS]
        no_worse, count = runs.count_no_worse(law, comparison)
        table.add_row(get_title(law), *row, "" if law == comparison else f"{no_worse} of {count}")
    return table


def _build_cell(run: BenchRun, comparison: BenchRun, number: str) -> Text:
    is_better = run.law != comparison.law and run.is_no_worse(comparison, number)
    return Text(format_run_number(run, number, unit=False), style="bold" if is_better else "")


def format_bench(runs: BenchRuns, comparison: str) -> str:
    """Format one row per law as Markdown, a figure per cell: before / peak / steady / recovery."""
    figures = [run.figure for run in runs.list_runs(comparison)]
    titles = [f"{figure.upper()}: {' / '.join(SHORT.values())} s" for figure in figures]
    head = ("law", *titles, f"no worse than {get_title(comparison)}")
    lines = [head, ("---",) * len(head)]
    for law in runs.laws:
        cells = {
            run.figure: " / ".join(format_run_number(run, number, unit=False) for number in NUMBERS)
            for run in runs.list_runs(law)
        }
        no_worse, count = runs.count_no_worse(law, comparison)
        row = [cells.get(figure, "") for figure in figures]
        lines.append((get_title(law), *row, "" if law == comparison else f"{no_worse} of {count}"))
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)


def build_section(runs: BenchRuns, law: str) -> list[str]:
    """Build the section of a law's page compared with NDOBC; empty without results."""
    if law not in runs.laws:
        return []
    lines = [f"| on the emulator, through CAN | {get_title(law)} | NDOBC |", "| --- | --- | --- |"]
    lines += [
        f"| Figure {run.figure.upper()}: {name} | {format_run_number(run, number)}"
        f" | {format_run_number(baseline, number)} |"
        for run, baseline in runs.pair(law, PAPERS_LAW)
        for number, name in LONG.items()
    ]
    return ["", *lines, "", *_describe_ends(runs.list_runs(law)), *_describe_count(runs, law)]


def _describe_ends(runs: tuple[BenchRun, ...]) -> list[str]:
    ends = [f"Figure {run.figure.upper()}: {label_fault(run.fault)}" for run in runs if run.fault]
    return [f"Ended early by the bench: {'; '.join(ends).lower()}.", ""] if ends else []


def _describe_count(runs: BenchRuns, law: str) -> list[str]:
    versions = " and ".join(sorted({run.version for run in runs.list_runs(law)}))
    no_worse, count = runs.count_no_worse(law, PAPERS_LAW)
    verdict = "" if law == PAPERS_LAW else f"No worse than NDOBC in {no_worse} of {count}. "
    return [
        f"{verdict}Run by SVSA Lab {versions} in lockstep. To repeat it:"
        f" `svsa ranking bench {law}`."
    ]

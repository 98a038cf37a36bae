"""Documentation written from the results: the laws' pages and their index."""

from pathlib import Path

from svsa.control.installed import PAPERS_LAW, get_law, get_title
from svsa.evaluation.ranking.bench_runs import BenchRuns
from svsa.evaluation.ranking.bench_table import format_bench
from svsa.evaluation.ranking.entry import DECLARED, get_entry_title
from svsa.evaluation.ranking.law_page import (
    PAPERS_LOAD,
    build_law_page,
    build_margins,
    describe_provenance,
)
from svsa.evaluation.ranking.results import SIGNIFICANT, Results
from svsa.evaluation.ranking.row import Row
from svsa.evaluation.ranking.table import RECOVERY, format_markdown, format_number

FOLDER = Path("docs") / "laws"
_NOT_IMPLEMENTED = (
    "## Not implemented",
    "",
    'M. Trumić, F. Angelini, K. Jovanović, A. Fagiolini, "Decoupled and Closed-Loop Motion and'
    " Stiffness Control for Articulated Soft Robots Driven by a Class of Electromechanical Variable"
    ' Stiffness Actuators", IEEE Trans. Control Syst. Technol. 34(2), 1051–1059, 2026,'
    " [doi:10.1109/TCST.2025.3637320](https://doi.org/10.1109/TCST.2025.3637320). Its abstract"
    " describes a cascade that shifts the eigenvalues of the actuator matrix and compensates the"
    " shift by integral action, fixed and adaptive. Its equations could not be found in a public"
    " source, so neither version is implemented.",
)


def build_index(results: Results, bench: BenchRuns) -> str:
    """Build the index of the laws in Markdown: ranking, summaries, results on the emulator."""
    lines = [
        "# The laws",
        "",
        "A page for each, with its idea, equation, needs and results. All run on the same plant,"
        " limits, noise and loads, and tuned with one budget, cost and noise limit"
        " ([protocol](../explanation/benchmark.md)). Success rates have Wilson's 95 % intervals."
        " *p* is McNemar's exact test with Holm's correction. Rows whose success rates do not"
        " differ significantly share a rank. Fixed scenarios run at both signs and eight phases."
        " *Largest load* is the largest step on the link up to which all 16 variants are held.",
        "",
        "![Position error against stiffness error, effort as size](pictures/pareto.png)",
        "",
        format_markdown(results),
        "",
        describe_results(results),
        "",
        "![Where NDOBC with the declared gains loses: load removal, a step on the link, a load at"
        " 2 Hz](pictures/losses.png)",
        "",
        "| law | what it does |",
        "| --- | --- |",
    ]
    lines += [
        f"| [{get_title(law)}]({law}.md) | {get_law(law).summary} |"
        for law in dict.fromkeys(row.law for row in results.rows)
    ]
    lines += ["", describe_provenance(results), "", *_NOT_IMPLEMENTED, ""]
    lines += ["## On the emulator", ""]
    lines += [
        "Figures 6A, 6B and 7 of the paper run on the emulator over CAN, in lockstep, with the"
        " default parameters of the laws. The table has the measured position errors in degrees"
        " (rms 1–5 s, peak after the cable's 2 N·m at 5 s, rms 8–20 s) and the recovery time in"
        " seconds. To repeat it, for any law:"
        f" `svsa ranking bench {' '.join(bench.laws)}`.",
        "",
        format_bench(bench, PAPERS_LAW),
        "",
    ]
    return "\n".join(lines)


def describe_results(results: Results) -> str:
    """Describe the main results in sentences."""
    first = [rank.key for rank in results.ranks if rank.rank == 1]
    compared = [rank for rank in results.ranks if rank.p_value is not None]
    differing = [rank for rank in compared if (rank.p_value or 0.0) < SIGNIFICANT]
    better = [rank for rank in differing if rank.only_this > rank.only_ndobc]
    worse = [rank for rank in differing if rank.only_this < rank.only_ndobc]
    names = ", ".join(map(get_entry_title, first))
    lines = [
        f"* First rank: {names}.",
        f"* Of {len(compared)} rows {len(better)} hold significantly more trials than the tuned"
        f" {get_title(PAPERS_LAW)}, {len(worse)} significantly fewer.",
    ]
    for key in (DECLARED, PAPERS_LAW, "ndobc_s", "ndobc_w"):
        row = next((row for row in results.rows if row.key == key), None)
        if row is not None:
            lines.append(f"* {_describe_row(row)}")
    return "\n".join(lines)


def _describe_row(row: Row) -> str:
    """Describe recovery, faults, stiffness error and effort of a row in a sentence."""
    rig, family = row.get_outcome(PAPERS_LOAD), row.families["A"]
    removal, recovery = row.get_outcome("load_removal"), rig.median[RECOVERY]
    stiffness = family.get_median("rms_stiffness_error_nm_per_rad")
    variation = family.get_median("torque1_variation_nm_per_s")
    return (
        f"{get_entry_title(row.key)}{'' if row.key == DECLARED else ', tuned'}: recovery from the"
        f" paper's load at σ = 15 {'–' if recovery is None else recovery} s (median), {rig.faults}"
        f" of {rig.runs} runs in a fault; {removal.faults} of {removal.runs} load removals in a"
        f" fault; trials of family A: median rms stiffness error {format_number(stiffness)}"
        f" N·m/rad, total variation of u1 {format_number(variation)} N·m/s."
    )


def publish(root: Path, results: Results, bench: BenchRuns) -> None:
    """Write pages, index and pictures into a source tree."""
    from svsa.evaluation.ranking.picture import save_law, save_losses, save_pareto

    pictures = root / FOLDER / "pictures"
    pictures.mkdir(parents=True, exist_ok=True)
    for name in dict.fromkeys(row.law for row in results.rows):
        page = build_law_page(results, bench, name, build_margins(name))
        (root / FOLDER / f"{name}.md").write_text(page, encoding="utf-8")
        save_law(results, name, pictures / f"{name}.png")
    (root / FOLDER / "README.md").write_text(build_index(results, bench), encoding="utf-8")
    save_pareto(results, pictures / "pareto.png")
    save_losses(pictures / "losses.png")

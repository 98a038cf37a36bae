"""What is written from the results: a page for each law, their index, and the README's table.

Every number comes from the results; idea, equation and source come from the law's own file.
"""

import re
from pathlib import Path

from svsa.analysis.design.margin_table import HEADS, compute_law_margins, format_margins
from svsa.control.call import is_measuring
from svsa.control.gains import Gains
from svsa.control.installed import PAPERS_LAW, get_law, get_notes, get_title
from svsa.control.law import Law, Nothing
from svsa.evaluation.ranking.bench_runs import BenchRuns
from svsa.evaluation.ranking.bench_table import build_section, format_bench
from svsa.evaluation.ranking.entry import DECLARED, get_entry_title
from svsa.evaluation.ranking.results import SIGNIFICANT, Results
from svsa.evaluation.ranking.row import Row
from svsa.evaluation.ranking.table import (
    PEAK,
    RECOVERY,
    RMS,
    SHARE,
    format_degrees,
    format_markdown,
    format_number,
    format_p,
    format_success,
)
from svsa.evaluation.tuning.judge import LOUD
from svsa.evaluation.tuning.tuned_law import Costs

FOLDER = Path("docs") / "laws"
README = Path("README.md")
_BLOCK = re.compile(r"(<!-- ranking -->\n).*?(<!-- /ranking -->)", re.DOTALL)
_EQUATION = re.compile(r"Eq \d+")
_DOI = re.compile(r"doi:(10\.\d{4,}/\S+)")
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
_ESTIMATES = {
    "none": "No estimate of the load.",
    "observer": "ŵ of the loop's disturbance observer.",
    "own": "An estimate of the load that it makes itself.",
}
_VARIANTS = {
    "tuned": "tuned",
    "declared": "gains declared for the paper, which prints none",
    "default": "default parameters, not tuned",
}
_TRIAL_METRICS = (
    (RMS, "rms position error [°]", 57.29577951308232),
    (PEAK, "peak position error [°]", 57.29577951308232),
    (RECOVERY, "recovery time [s]", 1.0),
    ("steady_state_position_error_rad", "steady-state position error [°]", 57.29577951308232),
    ("rms_stiffness_error_nm_per_rad", "rms stiffness error [N·m/rad]", 1.0),
    (SHARE, "peak stiffness error [% of σ_d]", 100.0),
    ("rms_torque1_nm", "rms u1 [N·m]", 1.0),
    ("rms_torque2_nm", "rms u2 [N·m]", 1.0),
    ("work_j", "mechanical work of the motors [J]", 1.0),
    ("torque1_variation_nm_per_s", "total variation of u1 [N·m/s]", 1.0),
)


def build_law_page(results: Results, bench: BenchRuns, name: str, margins: str) -> str:
    """The page of a law, Markdown. bench: runs on the emulator. margins: see `build_margins`."""
    law = get_law(name)
    rows = [row for row in results.rows if row.law == name]
    shown = rows if name == PAPERS_LAW else [*rows, results.get_row(DECLARED)]
    lines = [
        f"# {law.title}",
        "",
        law.summary,
        "",
        f"![{law.title} compared with NDOBC, declared gains: paper's load, load removal, errors of"
        f" the trials](pictures/{name}.png)",
        "",
        f"$${law.equation}$$",
        "",
        *_cite(law),
        f"## Idea, and what it assumes\n\n{get_notes(name)}\n",
        "## What it needs\n",
        *(f"* {need}" for need in _list_needs(law)),
        *_build_parameters(law, rows),
        "\n## Results\n",
        *_describe_tuning(rows),
        "",
        *_build_table(
            ("", *(get_entry_title(row.key) for row in shown)),
            [
                ("rank", *(str(results.get_rank(row.key).rank) for row in shown)),
                *(
                    (
                        f"family {family}: held, % (95 %)",
                        *(format_success(row.families[family]) for row in shown),
                    )
                    for family in rows[0].families
                ),
                (
                    "p against NDOBC, declared gains",
                    *(format_p(results.get_rank(row.key).p_value) for row in shown),
                ),
                ("largest load [N·m]", *(f"{row.largest_load_nm:g}" for row in shown)),
                (
                    "torque at rest, rms [N·m]",
                    *(format_number(row.noise.rms_nm) for row in shown),
                ),
                (
                    "torque variation at rest [N·m/s]",
                    *(format_number(row.noise.variation_nm_per_s) for row in shown),
                ),
            ],
        ),
        "",
        "Fixed scenarios at both signs and 8 phases: peak position error, peak stiffness error,"
        " recovery time, each median / worst.",
        "",
        *_build_scenarios(rows[0]),
        "",
        "Trials: median and 90 % quantile.",
        "",
        *_build_trials(rows[0]),
        "",
        _describe_provenance(results),
        margins,
        *build_section(bench, name),
        "",
        "[All laws](README.md)",
        "",
    ]
    return "\n".join(lines)


def _build_table(head: tuple[str, ...], rows: list[tuple[str, ...]]) -> list[str]:
    lines = [head, ("---",) * len(head), *rows]
    return [f"| {' | '.join(cells)} |" for cells in lines]


def _build_scenarios(row: Row) -> list[str]:
    head = ("scenario", "peak [°]", "stiffness [% of σ_d]", "recovery [s]", "held", "faults")
    rows = []
    for one in row.scenarios:
        pairs = [
            " / ".join(write(values[metric]) for values in (one.median, one.worst_values))
            for metric, write in (
                (PEAK, format_degrees),
                (SHARE, lambda value: format_number(None if value is None else 100.0 * value)),
                (RECOVERY, lambda value: "–" if value is None else f"{value:.3g}"),
            )
        ]
        rows.append((one.title, *pairs, f"{one.held} of {one.runs}", str(one.faults)))
    return _build_table(head, rows)


def _build_trials(row: Row) -> list[str]:
    head = ("", *(f"family {family}" for family in row.families))
    rows = []
    for metric, title, scale in _TRIAL_METRICS:
        cells = []
        for family in row.families.values():
            values = (family.metrics[metric][index] for index in (4, 6))
            cells.append(
                " / ".join("–" if value is None else f"{scale * value:.3g}" for value in values)
            )
        rows.append((title, *cells))
    return _build_table(head, rows)


def build_margins(name: str) -> str:
    """Compute a law's margins, and write the section of its page on them, Markdown."""
    lines = [
        "\n## Margins about rest\n",
        f"| σ, N·m/rad | {' | '.join(HEADS)} |",
        "| --- " * (1 + len(HEADS)) + "|",
    ]
    for sigma, margins in compute_law_margins(name):
        lines.append(f"| {sigma:g} | {' | '.join(format_margins(margins))} |")
    text = (
        "\nOf the sampled loop, linearized on the rig with the law's defaults, without limits of"
        " torque: [how they are defined](../stability.md#margins). The same again:"
        f" `svsa margins {name}`."
    )
    return "\n".join([*lines, text])


def _cite(law: Law) -> list[str]:
    if _EQUATION.fullmatch(law.source):
        return [f"Source: {law.source} of the paper", ""]
    linked = _DOI.sub(r"[doi:\1](https://doi.org/\1)", law.source)
    return [f"Source: {linked}", ""] if linked else []


def _list_needs(law: Law) -> list[str]:
    size = len(law.start_memory())
    memory = "Nothing of the past." if law.memory is Nothing else f"A memory of {size} numbers."
    measured = ["The positions that the encoders measure."] if is_measuring(law.control) else []
    return [_ESTIMATES[law.estimate], *measured, memory]


def _build_parameters(law: Law, rows: list[Row]) -> list[str]:
    """Parameters with defaults and tuned values."""
    tuned = next((row.tuning.values for row in rows if row.tuning), {})
    if law.parameters is Gains:
        values = ", ".join(f"{name} {value:.4g}" for name, value in tuned.items())
        return ["* The gains of the run, of Eq 25.", *([f"* Tuned: {values}."] if values else [])]
    lines = []
    for name, field in law.parameters.model_fields.items():
        extra = field.json_schema_extra if isinstance(field.json_schema_extra, dict) else {}
        unit, symbol = str(extra.get("unit", "")), str(extra.get("symbol", "") or name)
        meaning = (field.description or name).removesuffix(f", {unit}")
        found = [
            value for label, value in tuned.items() if label == name or label.startswith(name + "[")
        ]
        values = ", ".join(f"{value:.4g}" for value in found)
        lines.append((symbol, meaning, str(field.default), values, unit))
    head = ("parameter", "", "default", "tuned", "unit")
    return ["", *_build_table(head, lines)] if lines else []


def _describe_tuning(rows: list[Row]) -> list[str]:
    lines = []
    for row in rows:
        if row.tuning is None:
            lines.append(f"* {get_entry_title(row.key)}: {_VARIANTS[row.variant]}.")
            continue
        one = row.tuning
        lines.append(
            f"* {get_entry_title(row.key)}: {one.method}, {one.candidates} candidates on"
            f" {one.trials} training trials, the best ten on {one.validation} validation trials,"
            f" seed {one.seed}: {_describe_costs(one.before)} → {_describe_costs(one.after)}."
            f" Noise limit {one.noise_limit_nm_per_s:.0f} N·m/s."
        )
    return lines


def _describe_costs(costs: Costs) -> str:
    if costs.cost >= LOUD:
        return "above the noise limit"
    return f"cost {costs.cost:.3f}, {costs.held} held"


def _describe_provenance(results: Results) -> str:
    versions = " and ".join(sorted({row.version for row in results.rows}))
    return (
        f"Simulated by SVSA Lab {versions}; protocol {results.protocol}, {results.trials} trials of"
        f" each family, seed {results.seed}. Held: {results.criterion}. The same again:"
        f" `svsa ranking run --trials {results.trials} --seed {results.seed}`."
    )


def build_index(results: Results, bench: BenchRuns) -> str:
    """The table of laws, and those that ran on the emulator."""
    lines = [
        "# The laws",
        "",
        "A page for each, with its idea, equation, needs and results. All run on the same plant,"
        " limits, noise and loads, and tuned with one budget, cost and noise limit"
        " ([protocol](../decisions/26-evaluation.md)). Rows whose success rates do not differ"
        " significantly share a rank.",
        "",
        "![Position error against stiffness error, effort as size](pictures/pareto.png)",
        "",
        format_markdown(results),
        "",
        "| law | what it does |",
        "| --- | --- |",
    ]
    lines += [
        f"| [{get_title(law)}]({law}.md) | {get_law(law).summary} |"
        for law in dict.fromkeys(row.law for row in results.rows)
    ]
    lines += ["", _describe_provenance(results), "", *_NOT_IMPLEMENTED, ""]
    lines += ["## On the emulator", ""]
    lines += [
        "The paper's bench figures through CAN, frame by frame, in lockstep: position errors in"
        " degrees as the bench measures them (rms 1–5 s, peak after the cable's 2 N·m at 5 s, rms"
        " 8–20 s), recovery in seconds, with the laws' defaults. The same again, for any law:"
        f" `svsa ranking bench {' '.join(bench.laws)}`.",
        "",
        format_bench(bench, PAPERS_LAW),
        "",
    ]
    return "\n".join(lines)


def describe_results(results: Results) -> str:
    """What follows from the results, in sentences."""
    first = [rank.key for rank in results.ranks if rank.rank == 1]
    compared = [rank for rank in results.ranks if rank.p_value is not None]
    differing = [rank for rank in compared if (rank.p_value or 0.0) < SIGNIFICANT]
    better = [rank for rank in differing if rank.only_this > rank.only_ndobc]
    worse = [rank for rank in differing if rank.only_this < rank.only_ndobc]
    names = ", ".join(map(get_entry_title, first))
    lines = [
        f"* First rank: {names}.",
        f"* Of {len(compared)} rows {len(better)} hold significantly more trials than NDOBC with"
        f" the declared gains, {len(worse)} significantly fewer.",
    ]
    papers = results.get_row(DECLARED)
    for key in (PAPERS_LAW, "ndobc_s", "ndobc_w"):
        row = next((one for one in results.rows if one.key == key), None)
        if row is not None:
            lines.append(f"* {_compare_row(row, papers)}")
    return "\n".join(lines)


def _compare_row(row: Row, papers: Row) -> str:
    """A row and NDOBC with the declared gains: recovery, stiffness, effort, load removals."""

    def read(one: Row) -> str:
        rig, family = one.get_outcome("rig_4a"), one.families["A"]
        removal = one.get_outcome("load_removal")
        recovery = rig.median[RECOVERY]
        stiffness = family.get_median("rms_stiffness_error_nm_per_rad")
        variation = family.get_median("torque1_variation_nm_per_s")
        return (
            f"recovery from the paper's load at σ = 15 {'–' if recovery is None else recovery} s"
            f" (median), {rig.faults} of {rig.runs} runs in a fault; {removal.faults} of"
            f" {removal.runs} load removals in a fault; trials of family A: median rms stiffness"
            f" error {format_number(stiffness)} N·m/rad, total variation of u1"
            f" {format_number(variation)} N·m/s"
        )

    return (
        f"{get_entry_title(row.key)}, {_VARIANTS[row.variant]}: {read(row)}. NDOBC, declared gains:"
        f" {read(papers)}."
    )


def fill_readme(text: str, results: Results) -> str:
    """The README with table and statements between its marks."""
    block = f"{format_markdown(results)}\n\n{describe_results(results)}\n\n"
    provenance = _describe_provenance(results)
    return _BLOCK.sub(lambda m: f"{m[1]}{block}{provenance}\n{m[2]}", text)


def publish(root: Path, results: Results, bench: BenchRuns) -> None:
    """Write pages, index, pictures and the README's table into a source tree."""
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
    readme = (root / README).read_text(encoding="utf-8")
    (root / README).write_text(fill_readme(readme, results), encoding="utf-8")

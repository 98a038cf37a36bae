"""Build the documentation page of a law from the text of its file and the results."""

import math
import re

from svsa.analysis.design.margin_table import HEADS, compute_law_margins, format_margins
from svsa.control.call import is_measuring
from svsa.control.gains import Gains
from svsa.control.installed import PAPERS_LAW, get_law, get_notes, get_title
from svsa.control.law import Law, Nothing
from svsa.evaluation.ranking.bench_runs import BenchRuns
from svsa.evaluation.ranking.bench_table import build_section
from svsa.evaluation.ranking.entry import get_entry_title, get_reference
from svsa.evaluation.ranking.results import Results
from svsa.evaluation.ranking.row import Row
from svsa.evaluation.ranking.table import (
    PEAK,
    RECOVERY,
    RMS,
    SHARE,
    format_degrees,
    format_number,
    format_p,
    format_success,
)
from svsa.evaluation.tuning.judge import LOUD
from svsa.evaluation.tuning.tuned_law import Costs

_EQUATION = re.compile(r"Eq \d+")
_DOI = re.compile(r"doi:(10\.\d{4,}/\S+)")
_DEGREE = math.degrees(1.0)
_ESTIMATES = {
    "none": "No estimate of the load.",
    "observer": "ŵ of the loop's disturbance observer.",
    "own": "Its own estimate of the load.",
}
VARIANTS = {
    "tuned": "tuned",
    "declared": "gains declared for the paper, which prints none",
    "default": "default parameters, not tuned",
}
_TRIAL_METRICS = (
    (RMS, "rms position error [°]", _DEGREE),
    (PEAK, "peak position error [°]", _DEGREE),
    (RECOVERY, "recovery time [s]", 1.0),
    ("steady_state_position_error_rad", "steady-state position error [°]", _DEGREE),
    ("rms_stiffness_error_nm_per_rad", "rms stiffness error [N·m/rad]", 1.0),
    (SHARE, "peak stiffness error [% of σ_d]", 100.0),
    ("rms_torque1_nm", "rms u1 [N·m]", 1.0),
    ("rms_torque2_nm", "rms u2 [N·m]", 1.0),
    ("work_j", "mechanical work of the motors [J]", 1.0),
    ("torque1_variation_nm_per_s", "total variation of u1 [N·m/s]", 1.0),
)
PAPERS_LOAD = "rig_4a"
"""A fixed scenario: the paper's load at σ = 15 with the rig's effects."""


def build_law_page(results: Results, bench: BenchRuns, name: str, margins: str) -> str:
    """Build the page of a law in Markdown.

    Args:
        results: Results of the ranking.
        bench: Runs on the emulator.
        name: Name of the law.
        margins: See `build_margins`.

    Returns:
        The page.
    """
    law = get_law(name)
    rows = [row for row in results.rows if row.law == name]
    shown = rows if name == PAPERS_LAW else [*rows, results.get_row(PAPERS_LAW)]
    reference = get_entry_title(get_reference(name))
    lines = [
        f"# {law.title}",
        "",
        law.summary,
        "",
        f"![{law.title} compared with {reference}: paper's load, load removal, errors of"
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
                    f"p against the tuned {get_title(PAPERS_LAW)}",
                    *(format_p(results.get_rank(row.key).p_value) for row in shown),
                ),
                ("largest load [N·m]", *(f"{row.largest_load_nm:g}" for row in shown)),
                ("torque at rest, rms [N·m]", *(format_number(row.noise.rms_nm) for row in shown)),
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
        *_compare_with_ndobc(results, rows),
        describe_provenance(results),
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
    for outcome in row.scenarios:
        pairs = [
            " / ".join(write(values[metric]) for values in (outcome.median, outcome.worst_values))
            for metric, write in (
                (PEAK, format_degrees),
                (SHARE, lambda value: format_number(None if value is None else 100.0 * value)),
                (RECOVERY, lambda value: "–" if value is None else f"{value:.3g}"),
            )
        ]
        held = f"{outcome.held} of {outcome.runs}"
        rows.append((outcome.title, *pairs, held, str(outcome.faults)))
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


def _compare_with_ndobc(results: Results, rows: list[Row]) -> list[str]:
    """Compare the medians of the tuned law with those of tuned NDOBC."""
    ndobc = results.get_row(PAPERS_LAW)
    if rows[0].key == ndobc.key or rows[0].tuning is None:
        return []
    worse, better = [], []
    for title, law_value, ndobc_value in zip(
        _COMPARED, _read_compared(rows[0]), _read_compared(ndobc), strict=True
    ):
        # A run that ended in a fault has no value; it counts as the worst.
        values = [math.inf if value is None else value for value in (law_value, ndobc_value)]
        if values[0] == values[1]:
            continue
        shown = " against ".join(
            "fault" if math.isinf(value) else f"{value:.3g}" for value in values
        )
        (worse if values[0] > values[1] else better).append(f"{title} {shown}")
    return [
        "Compared with NDOBC, tuned (medians, without a test of significance):",
        "",
        f"* worse: {'; '.join(worse) or 'none of these'}",
        f"* better: {'; '.join(better) or 'none of these'}",
        "",
    ]


_COMPARED = (
    "peak under the paper's load [°]",
    "recovery from the paper's load [s]",
    "rms position error of family A [°]",
    "rms stiffness error of family A [N·m/rad]",
    "rms u1 of family A [N·m]",
    "total variation of u1 of family A [N·m/s]",
    "torque variation at rest [N·m/s]",
)


def _read_compared(row: Row) -> tuple[float | None, ...]:
    """Read the compared medians of a row."""
    load, family = row.get_outcome(PAPERS_LOAD).median, row.families["A"]
    peak, rms = load[PEAK], family.get_median(RMS)
    return (
        None if peak is None else _DEGREE * peak,
        load[RECOVERY],
        None if rms is None else _DEGREE * rms,
        family.get_median("rms_stiffness_error_nm_per_rad"),
        family.get_median("rms_torque1_nm"),
        family.get_median("torque1_variation_nm_per_s"),
        row.noise.variation_nm_per_s,
    )


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
        "\nThe sampled loop is linearized on the rig with the law's defaults, without torque"
        " limits: see [the definitions](../stability.md#margins). To repeat it:"
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
    """Build the table of parameters with defaults and tuned values."""
    tuned = next((row.tuning.values for row in rows if row.tuning), {})
    if law.parameters is Gains:
        values = ", ".join(f"{name} {value:.4g}" for name, value in tuned.items())
        return ["* The gains of the run, of Eq 25.", *([f"* Tuned: {values}."] if values else [])]
    lines = []
    for name, field in law.parameters.model_fields.items():
        extra = field.json_schema_extra if isinstance(field.json_schema_extra, dict) else {}
        unit, symbol = str(extra.get("unit", "")), str(extra.get("symbol", "") or name)
        meaning = (field.description or name).removesuffix(f", {unit}")
        tuned_values = [
            value for label, value in tuned.items() if label == name or label.startswith(name + "[")
        ]
        values = ", ".join(f"{value:.4g}" for value in tuned_values)
        lines.append((symbol, meaning, str(field.default), values, unit))
    head = ("parameter", "", "default", "tuned", "unit")
    return ["", *_build_table(head, lines)] if lines else []


def _describe_tuning(rows: list[Row]) -> list[str]:
    lines = []
    for row in rows:
        if row.tuning is None:
            lines.append(f"* {get_entry_title(row.key)}: {VARIANTS[row.variant]}.")
            continue
        tuning = row.tuning
        lines.append(
            f"* {get_entry_title(row.key)}: {tuning.method}, {tuning.candidates} candidates on"
            f" {tuning.trials} training trials, the best ten on {tuning.validation} validation"
            f" trials, seed {tuning.seed}: {_describe_costs(tuning.before)} →"
            f" {_describe_costs(tuning.after)}."
            f" Noise limit {tuning.noise_limit_nm_per_s:.0f} N·m/s."
        )
    return lines


def _describe_costs(costs: Costs) -> str:
    if costs.cost >= LOUD:
        return "above the noise limit"
    return f"cost {costs.cost:.3f}, {costs.held} held"


def describe_provenance(results: Results) -> str:
    """Describe version, protocol, trials and seed of the results, and the command to repeat
    them.
    """
    versions = " and ".join(sorted({row.version for row in results.rows}))
    return (
        f"Simulated by SVSA Lab {versions}; protocol {results.protocol}, {results.trials} trials of"
        f" each family, seed {results.seed}. Held: {results.criterion}. To repeat it:"
        f" `svsa ranking run --trials {results.trials} --seed {results.seed}`."
    )

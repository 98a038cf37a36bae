"""What is written from the results: a page for each law, their index, and the README's table.

Every number comes from the results, and idea, equation and source from the law's own file.
"""

import re
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple

from svsa.actuators.faults import label_fault
from svsa.analysis.design.margin_table import HEADS, compute_law_margins, format_margins
from svsa.control.call import is_measuring
from svsa.control.gains import Gains
from svsa.control.installed import PAPERS_LAW, get_law, get_notes, get_title
from svsa.control.law import Law, Nothing
from svsa.evaluation.ranking.bench_runs import BenchRuns
from svsa.evaluation.ranking.bench_table import build_section, format_bench
from svsa.evaluation.ranking.results import Results
from svsa.evaluation.ranking.row import Row
from svsa.evaluation.ranking.table import format_markdown

FOLDER = Path("docs") / "laws"
README = Path("README.md")
LOSSES = Path("docs") / "laws" / "pictures" / "losses.png"
_BLOCK = re.compile(r"(<!-- ranking -->\n).*?(<!-- /ranking -->)", re.DOTALL)
_DOI = re.compile(r"doi:(10\.\d{4,}/\S+)")
_EQUATION = re.compile(r"Eq \d+")
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


class Column(NamedTuple):
    """A number of the table. scenario: the run that it is of, "" where it is of many."""

    title: str
    unit: str
    read: Callable[[Row], float | None]
    scenario: str = ""
    is_high_better: bool = False

    def format_cell(self, row: Row) -> str:
        """The number, or why there is none."""
        value = self.read(row)
        if value is not None:
            return f"{value:.3g}{self.unit}"
        fault = row.faults.get(self.scenario)
        return label_fault(fault).lower() if fault else "never" if self.scenario else "fault"

    def find_place(self, row: Row, rows: tuple[Row, ...]) -> int:
        """Which place the row takes, from 1; shared places are the first of them."""
        value = self._order(row)
        return 1 + sum(self._order(other) < value for other in rows)

    def _order(self, row: Row) -> float:
        value = self.read(row)
        if value is None:
            return float("inf")
        return -value if self.is_high_better else value


def _read_rms(scenario: str) -> Callable[[Row], float | None]:
    return lambda row: row.get_outcome(scenario).rms_deg


COLUMNS = (
    Column("Score", "", lambda row: row.score, is_high_better=True),
    Column("Figure 4A, ideal: settled", "°", lambda row: row.ideal_4a.steady_deg, "ideal_4a"),
    Column("Figure 4A on the rig: peak", "°", lambda row: row.rig_4a.peak_deg, "rig_4a"),
    Column("Figure 4A on the rig: settled", "°", lambda row: row.rig_4a.steady_deg, "rig_4a"),
    Column("Figure 4A on the rig: recovery", " s", lambda row: row.rig_4a.recovery_s, "rig_4a"),
    Column("Load removal: peak", "°", lambda row: row.load_removal_peak_deg, "load_removal"),
    Column("Faults of 48 load removals", "", lambda row: row.load_removal_faults_of_48),
    Column(
        "Worst of 48 load removals: settled", "°", lambda row: row.load_removal_steady_state_deg,
    ),
    Column("1.5 N·m at 2 Hz: rms", "°", lambda row: row.sine_2hz_rms_deg, "sine_2hz"),
    Column("3 kg on the arm: rms", "°", lambda row: row.mass_rms_deg, "mass"),
    Column("Impulses of 3 N·m: rms", "°", _read_rms("pulses"), "pulses"),
    Column("Five times the noise: rms", "°", _read_rms("noise_5"), "noise_5"),
    Column("100 trials: median rms", "°", lambda row: row.trials_median_deg),
    Column("100 trials: how many fail", "", lambda row: row.trials_fails),
    Column("±50 % corners: how many of 8 fail", "", lambda row: row.corners_fails_of_8),
    Column(
        "Largest step on the link", " N·m", lambda row: row.largest_link_step_nm,
        is_high_better=True,
    ),
)  # fmt: skip


def build_law_page(results: Results, bench: BenchRuns, name: str, margins: str) -> str:
    """The page of a law, Markdown. bench: runs on the emulator. margins: see `build_margins`."""
    law, row, papers = get_law(name), results.get_row(name), results.get_row(PAPERS_LAW)
    count = len(results.rows)
    lines = [
        f"# {law.title}",
        "",
        law.summary,
        "",
        f"![{law.title} beside {'FL' if name == PAPERS_LAW else 'NDOBC'}: figure 4A on the rig,"
        f" load removal, and the six sweeps](pictures/{name}.png)",
        "",
        f"$${law.equation}$$",
        "",
        *_cite(law),
        f"## Idea, and what it assumes\n\n{get_notes(name)}\n",
        "## What it needs\n",
        *(f"* {need}" for need in _list_needs(law)),
        *_build_parameters(law),
        "\n## Where it wins, and where it fails\n",
        *_judge(results, row),
        "",
        f"| | {law.title} | NDOBC | place of {count} |",
        "| --- | --- | --- | --- |",
    ]
    for column in COLUMNS:
        place = column.find_place(row, results.rows)
        cells = (column.title, column.format_cell(row), column.format_cell(papers), str(place))
        lines.append(f"| {' | '.join(cells)} |")
    lines += ["", "| sweep | held | NDOBC |", "| --- | --- | --- |"]
    for one, other in zip(row.sweeps, papers.sweeps, strict=True):
        lines.append(f"| {one.title} | {one.share:.0%} | {other.share:.0%} |")
    lines += [
        "",
        _describe_provenance(results, [row]),
        margins,
        *build_section(bench, name),
        "",
        "[All laws](README.md)",
        "",
    ]
    return "\n".join(lines)


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
    measured = ["The positions that the encoders say."] if is_measuring(law.control) else []
    return [_ESTIMATES[law.estimate], *measured, memory]


def _build_parameters(law: Law) -> list[str]:
    if law.parameters is Gains:
        return ["* The gains of the run, of Eq 25."]
    rows = []
    for name, field in law.parameters.model_fields.items():
        extra = field.json_schema_extra if isinstance(field.json_schema_extra, dict) else {}
        unit, symbol = str(extra.get("unit", "")), str(extra.get("symbol", "") or name)
        meaning = (field.description or name).removesuffix(f", {unit}")
        rows.append(f"| {symbol} | {meaning} | {field.default} | {unit} |")
    if not rows:
        return []
    return ["", "| parameter | | default | unit |", "| --- | --- | --- | --- |", *rows]


def _judge(results: Results, row: Row) -> list[str]:
    """In words: where it is among the best three or the worst three, and what ended early."""
    count = len(results.rows)
    places = {one.title: one.find_place(row, results.rows) for one in COLUMNS}
    wins = [f"{title} ({place})" for title, place in places.items() if place <= 3]
    loses = [f"{title} ({place})" for title, place in places.items() if place > count - 3]
    faults = [f"{one.title}: {label_fault(one.fault).lower()}" for one in row.outcomes if one.fault]
    return [
        f"* Among the best three of {count}: {', '.join(wins) or 'nowhere'}.",
        f"* Among the last three: {', '.join(loses) or 'nowhere'}.",
        f"* Runs that ended early: {'; '.join(faults) or 'none'}.",
    ]


def _describe_provenance(results: Results, rows: Sequence[Row]) -> str:
    versions = " and ".join(sorted({row.version for row in rows}))
    return (
        f"Simulated by SVSA Lab {versions} with the law's defaults; suite {results.suite}, trials"
        f" of the {'public seed' if results.is_public else 'seed ' + results.seed}. The same again:"
        " `svsa ranking run`."
    )


def build_index(results: Results, bench: BenchRuns) -> str:
    """The list of laws, best score first, and those that ran on the emulator."""
    rows = sorted(results.rows, key=lambda row: -row.score)
    lines = [
        "# The laws",
        "",
        "A page for each, with its idea, equation, needs, and where it wins and fails. All are run"
        " on the same plant, limits, noise and loads; the page *Ranking* of the lab opens any of"
        " these runs. The score is 0.5 robustness + 0.3 share of trials held + 0.2 accuracy.",
        "",
        "| law | score | what it does |",
        "| --- | --- | --- |",
    ]
    for row in rows:
        summary = get_law(row.law).summary
        lines.append(f"| [{get_title(row.law)}]({row.law}.md) | {row.score:.2f} | {summary} |")
    lines += ["", _describe_provenance(results, rows), "", *_NOT_IMPLEMENTED, ""]
    lines += ["## On the emulator", ""]
    lines += [
        "The paper's bench figures through CAN, frame by frame, in lockstep: position errors in"
        " degrees as the bench measures them (rms 1–5 s, peak after the cable's 2 N·m at 5 s, rms"
        " 8–20 s), recovery in seconds. The same again, for any law:"
        f" `svsa ranking bench {' '.join(bench.laws)}`.",
        "",
        format_bench(bench, PAPERS_LAW),
        "",
    ]
    return "\n".join(lines)


def fill_readme(text: str, results: Results) -> str:
    """The README with the table between its marks."""
    return _BLOCK.sub(lambda m: f"{m[1]}{format_markdown(results.rows)}\n{m[2]}", text)


def publish(root: Path, results: Results, bench: BenchRuns) -> None:
    """Write pages, index, pictures and the README's table into a source tree."""
    from svsa.evaluation.ranking.picture import save_law, save_losses

    pictures = root / FOLDER / "pictures"
    pictures.mkdir(parents=True, exist_ok=True)
    for row in results.rows:
        page = build_law_page(results, bench, row.law, build_margins(row.law))
        (root / FOLDER / f"{row.law}.md").write_text(page, encoding="utf-8")
        save_law(results, row.law, pictures / f"{row.law}.png")
    (root / FOLDER / "README.md").write_text(build_index(results, bench), encoding="utf-8")
    save_losses(root / LOSSES)
    readme = (root / README).read_text(encoding="utf-8")
    (root / README).write_text(fill_readme(readme, results), encoding="utf-8")

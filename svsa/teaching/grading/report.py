"""Grades as an HTML page and as CSV: an overview of the class, and each student's criteria."""

import csv
import io
import unicodedata
from collections.abc import Sequence
from html import escape
from statistics import mean, median

from svsa.teaching.grading.grade import Grade

_STYLE = """
:root { color-scheme: light dark; }
body { font: 16px/1.5 system-ui, sans-serif; max-width: 60rem; margin: 2rem auto; padding: 0 1rem; }
h2 { margin-top: 2.5rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; }
th, td { text-align: left; padding: .3rem .8rem .3rem 0; vertical-align: top;
  border-bottom: 1px solid color-mix(in srgb, currentColor 25%, transparent); }
td.number, th.number { text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums; }
small { overflow-wrap: anywhere; }
.feedback { white-space: pre-wrap; overflow-wrap: anywhere; }
"""
HEADINGS = (
    "student", "exercise", "points", "max_points", "submission", "seed", "version", "person",
)  # fmt: skip


def write_csv(grades: Sequence[Grade]) -> str:
    """Write a CSV: one line per grade, then a column of points for each criterion."""
    names = dict.fromkeys(_name(grade, at) for grade in grades for at in range(len(grade.criteria)))
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow([*HEADINGS, *names])
    for grade in grades:
        points = {
            _name(grade, at): f"{criterion.points:g}" for at, criterion in enumerate(grade.criteria)
        }
        row = (
            *(_guard(word) for word in (grade.student, grade.exercise)),
            f"{grade.points:g}", f"{grade.max_points:g}", grade.submission, grade.seed or "",
            grade.version, _guard(grade.person),
        )  # fmt: skip
        table.writerow([*row, *(points.get(name, "") for name in names)])
    return text.getvalue()


def write_page(grades: Sequence[Grade]) -> str:
    """Write a self-contained HTML page: the class's table, then each student's feedback."""
    parts = ["<h1>Grades</h1>", _write_summary(grades), _write_table(grades)]
    parts += [_write_grade(grade, f"grade-{at}") for at, grade in enumerate(grades)]
    return (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<title>Grades</title><style>{_STYLE}</style></head><body><main>\n"
        + "\n".join(parts)
        + "\n</main></body></html>\n"
    )


def _name(grade: Grade, at: int) -> str:
    criterion = grade.criteria[at]
    return f"{grade.exercise} / {criterion.step} / {criterion.name}"


def _guard(word: str) -> str:
    """Prefix a text that a spreadsheet would read as a formula, also in full-width signs."""
    is_formula = unicodedata.normalize("NFKC", word).lstrip().startswith(("=", "+", "-", "@"))
    return f"'{word}" if is_formula or word.startswith(("\t", "\r")) else word


def _write_summary(grades: Sequence[Grade]) -> str:
    lines = []
    for exercise in dict.fromkeys(grade.exercise for grade in grades):
        shares = [grade.points / grade.max_points for grade in grades if grade.exercise == exercise]
        count = "1 submission" if len(shares) == 1 else f"{len(shares)} submissions"
        statistics = f"mean {mean(shares):.0%}, median {median(shares):.0%}"
        lines.append(f"<li>{escape(exercise)}: {count}, {statistics}</li>")
    return f"<ul>{''.join(lines)}</ul>"


def _write_table(grades: Sequence[Grade]) -> str:
    rows = "".join(
        f'<tr><td><a href="#grade-{at}">{escape(grade.student)}</a>'
        f" <small>{escape(grade.person)}</small></td>"
        f"<td>{escape(grade.exercise)}</td>"
        f"{_write_points(grade.points, grade.max_points)}</tr>"
        for at, grade in enumerate(grades)
    )
    return _write_rows('<th>Student</th><th>Exercise</th><th class="number">Points</th>', rows)


def _write_grade(grade: Grade, anchor: str) -> str:
    rows = "".join(
        f"<tr><td>{escape(criterion.step)}</td><td>{escape(criterion.name)}</td>"
        f"{_write_points(criterion.points, criterion.max_points)}"
        f'<td class="feedback">{escape(criterion.feedback)}</td></tr>'
        for criterion in grade.criteria
    )
    seed = f"; trials of seed {grade.seed}" if grade.seed else ""
    walls = "" if grade.is_isolated else "; practice: its law was not isolated"
    head = f"{escape(grade.student)}: {escape(grade.exercise)}"
    runs = "".join(
        f"<p><small>Run {escape(run.run_id)}. {escape(run.description)}</small></p>"
        for run in grade.runs
    )
    heads = '<th>Step</th><th>Criterion</th><th class="number">Points</th><th>Feedback</th>'
    return (
        f'<h2 id="{anchor}">{head}</h2>\n{_write_rows(heads, rows)}{runs}'
        f"<p><small>Submission {grade.submission}{seed}; svsa {escape(grade.version)}{walls}."
        "</small></p>"
    )


def _write_points(points: float, most: float) -> str:
    return f'<td class="number">{points:.2f} of {most:g}</td>'


def _write_rows(heads: str, rows: str) -> str:
    table = f"<table><thead><tr>{heads}</tr></thead><tbody>{rows}</tbody></table>"
    return f'<div class="wide" role="region" aria-label="Table" tabindex="0">{table}</div>'

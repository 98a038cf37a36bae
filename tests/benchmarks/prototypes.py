"""Every law beside its independent prototype, column by column, as Markdown.

    python -m tests.benchmarks.prototypes [LAW …]

From the published results; laws that are named are measured anew. A cell is what was found, over
the prototype's, and × by how much where it is more than 5 % worse.
"""

import math
import sys
from collections.abc import Sequence

from svsa.evaluation.ranking.measure import Entry, measure_law
from svsa.evaluation.ranking.results import load_published
from tests.evaluation.ranking.prototypes import PROTOTYPES, Cell, Prototype, compare


def report(cell: Cell) -> str:
    """One cell, as "0.313 / 0.31" or "44 / 24 ×1.83"."""
    reported = f"{_format_number(cell.found)} / {_format_number(cell.figure)}"
    return reported if cell.holds else f"**{reported} ×{cell.ratio:.3g}**"


def _format_number(value: float) -> str:
    if math.isnan(value):
        return "–"
    return f"{value:.3g}" if math.isfinite(value) else "none"


def format_table(laws: Sequence[str]) -> str:
    """The table. laws: which of them are measured anew; the others are not asked."""
    rows = [measure_law(Entry(law)) for law in laws] or [
        load_published().get_row(law) for law in PROTOTYPES
    ]
    lines = [("law", *Prototype._fields), ("---",) * (1 + len(Prototype._fields))]
    lines += [(row.law, *map(report, compare(row))) for row in rows]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)


if __name__ == "__main__":
    print(format_table(sys.argv[1:]))

"""Every law that had an independent prototype is as good as it in every column, within 5 %."""

import math

import pytest

from svsa.evaluation.ranking.results import load_published
from tests.evaluation.ranking.prototypes import ERRORS, KEPT, PROTOTYPES, Cell, compare

BEHIND = {
    ("nmpc", "step"): 2.0,
}
"""What is not held, at what it was measured: 2 N·m less (4); NMPC's page says why."""


@pytest.mark.parametrize("law", PROTOTYPES | KEPT)
def test_a_law_is_as_good_as_its_prototype(law):
    """In what was published, which `test_results` holds to what is measured."""
    for cell in compare(load_published().get_row(law)):
        kept = BEHIND.get((law, cell.column))
        if kept is None:
            assert cell.holds, cell
        else:
            assert cell.column not in ERRORS
            assert (cell.found, cell.holds) == (kept, False), cell


def test_a_figure_is_held_from_its_worse_side_only():
    assert Cell("mass", 0.32, 0.31).holds
    assert not Cell("mass", 0.33, 0.31).holds
    assert Cell("mass", 0.1, math.inf).holds, "the prototype ended in a fault"
    assert Cell("mass", math.inf, math.inf).holds
    assert not Cell("mass", math.inf, 0.31).holds
    assert Cell("step", 8.5, 2.0).holds
    assert not Cell("step", 2.0, 2.5).holds
    assert Cell("step", 0.0, 0.0).holds
    assert not Cell("faults", 1, 0).holds
    assert Cell("faults", 40, math.nan).holds

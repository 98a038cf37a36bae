"""Every law's row of the arena against the figures of independent prototypes: as near, or better.

ideal: figure 4A, rms before the load, peak, steady. rig: its peak, steady, and the time to within
2 %. off: peak when the load is taken off at σ = 15. u48: faults in 48 unloadings. sine: rms under
1.5 N·m at 2 Hz on the link. mass: rms under 3 kg. step: largest step on the link, N·m. Degrees;
"fault" where the prototype left the domain, and this law is expected to.
"""

import math
from functools import cache
from typing import Any, NamedTuple

import pytest

from svsa.arena.measure import Entry, measure_law

NEAR = 1.05
COUNTS = 1.15
"""A steady error on the rig is a cycle among counts, which any change moves by some per cent."""


class Mark(NamedTuple):
    ideal: tuple[float, float, float]
    rig: tuple[float, float, float]
    off: float | str
    u48: int
    sine: float
    mass: float
    step: float


NEVER = math.inf
MARKS = {
    "fl": Mark((0.0402, 12.06, 12.08), (12.07, 12.08, NEVER), 12.1, 0, 5.58, 6.78, 0.0),
    "ndobc": Mark((0.0012, 4.14, 0.0013), (5.63, 0.0072, 0.24), "fault", 32, 2.38, 0.314, 2.0),
    "fl_integral": Mark((0.0016, 4.69, 0.0017), (5.92, 0.0072, 0.32), 5.8, 16, 2.64, 0.351, 2.0),
    "ndobc_w": Mark((0.0002, 4.89, 0.0002), (6.15, 0.0075, 0.27), 6.7, 0, 1.11, 0.086, 8.5),
}


@cache
def measure(law: str) -> dict[str, Any]:
    return measure_law(Entry(law))


@pytest.mark.parametrize("law", MARKS)
def test_a_law_is_as_good_as_its_prototype(law):
    row, mark = measure(law), MARKS[law]
    for name, figures, steady in (("ideal_4a", mark.ideal, NEAR), ("rig_4a", mark.rig, COUNTS)):
        names = ("before_deg", "peak_deg", "steady_deg") if name == "ideal_4a" else (
            "peak_deg", "steady_deg", "recovery_s"
        )  # fmt: skip
        for column, figure in zip(names, figures, strict=True):
            found = math.inf if row[name][column] is None else row[name][column]
            near = steady if column == "steady_deg" else NEAR
            assert found <= near * figure, (name, column)
    assert row["unloading_faults_of_48"] <= mark.u48
    assert row["sine_2hz_rms_deg"] <= NEAR * mark.sine
    assert row["mass_rms_deg"] <= NEAR * mark.mass
    assert row["largest_link_step_nm"] >= mark.step
    if mark.off == "fault":
        assert row["faults"].get("unloading") == "deflection_limit"
    else:
        assert row["unloading_peak_deg"] <= NEAR * mark.off


@pytest.mark.parametrize("law", ["fl", "ndobc"])
def test_the_papers_laws_give_their_rows_and_no_better(law):
    """The scenarios are those of the figures: from both sides within 5 %."""
    row, mark = measure(law), MARKS[law]
    found = (*row["ideal_4a"].values(), row["sine_2hz_rms_deg"], row["mass_rms_deg"])
    assert found == pytest.approx((*mark.ideal, mark.sine, mark.mass), rel=0.05)
    assert row["rig_4a"]["peak_deg"] == pytest.approx(mark.rig[0], rel=0.05)
    assert row["unloading_faults_of_48"] == mark.u48
    assert row["largest_link_step_nm"] == mark.step


def test_ndobc_w_answers_the_open_question():
    """The paper leaves saturation open: no unloading is a fault, and 8 N·m are held at σ = 15."""
    row = measure("ndobc_w")
    assert row["faults"] == {}
    assert row["unloading_faults_of_48"] == 0
    assert row["largest_link_step_nm"] >= 8.0
    for column in ("sine_2hz_rms_deg", "mass_rms_deg"):
        assert row[column] < 0.5 * measure("ndobc")[column]

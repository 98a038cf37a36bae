"""The pictures of a study show its numbers."""

import numpy as np
import pytest
from matplotlib.collections import LineCollection
from matplotlib.container import BarContainer

from svsa.evaluation.statistics import Interval
from svsa.evaluation.studies.pictures import draw_sensitivity
from svsa.evaluation.studies.summary import Sensitivity

ISHIGAMI = Sensitivity(
    "ndobc",
    "rms_position_error_rad",
    1024,
    {"x1": Interval(0.314, 0.28, 0.35), "x2": Interval(0.442, 0.4, 0.5), "x3": Interval(0, 0, 0)},
    {
        "x1": Interval(0.558, 0.5, 0.6),
        "x2": Interval(0.442, 0.45, 0.5),
        "x3": Interval(0.244, 0.2, 0.3),
    },
)
"""An interval of a bootstrap may exclude its estimate, as that of x2's total does."""
ORDER = ["x3", "x2", "x1"]


def test_bars_of_sobol_indices_have_their_length_and_intervals():
    (axes,) = draw_sensitivity([ISHIGAMI]).axes
    assert [label.get_text() for label in axes.get_yticklabels()] == ORDER
    bars = [one for one in axes.containers if isinstance(one, BarContainer)]
    intervals = [one for one in axes.collections if isinstance(one, LineCollection)]
    own, total = ISHIGAMI.first_order, ISHIGAMI.total_order
    for order, bar, interval in zip((own, total), bars, intervals, strict=True):
        expected = [order[name] for name in ORDER]
        assert [patch.get_width() for patch in bar] == [one.value for one in expected]
        assert {patch.get_x() for patch in bar} == {0.0}
        middles = [patch.get_y() + patch.get_height() / 2 for patch in bar]
        for segment, one, at in zip(interval.get_segments(), expected, middles, strict=True):
            np.testing.assert_allclose(segment, [(one.low, at), (one.high, at)], atol=1e-12)
    assert axes.get_xlim()[0] == pytest.approx(0.0, abs=0.05)
    legend = axes.get_legend()
    assert legend is not None
    assert [text.get_text() for text in legend.get_texts()] == [
        "its own share",
        "with interactions",
    ]

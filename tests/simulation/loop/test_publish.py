"""A sample is stored in the columns of its fields."""

import numpy as np
import pytest

from svsa.actuators.signals import CHANNEL_NAMES, Sample
from svsa.numerics.compilation import compiled
from svsa.simulation.loop.publish import write_sample


@compiled
def write_all(rows, sample):
    for row in rows:
        write_sample(row, sample)


@pytest.mark.parametrize("order", ["C", "F"])
def test_every_field_is_in_the_column_of_its_channel(order):
    sample = Sample(**{name: float(column) for column, name in enumerate(CHANNEL_NAMES)})
    rows = np.full((3, len(CHANNEL_NAMES) + 1), np.nan, order=order)
    write_all(rows[1:, :-1], sample)
    assert np.isnan(rows[0]).all() and np.isnan(rows[:, -1]).all()
    np.testing.assert_array_equal(rows[1:, :-1], [sample, sample])
    assert sample.position_rad == sample[CHANNEL_NAMES.index("position_rad")]

"""Samples as pandas and xarray tables, with units in the attributes."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from svsa.actuators.signals import CHANNEL_NAMES, CHANNELS
from svsa.inputs.extras import require_extra

if TYPE_CHECKING:
    import pandas
    import xarray

TIME = "time_s"


def build_dataframe(samples: np.ndarray, attributes: Mapping[str, str]) -> "pandas.DataFrame":
    """Build a table with a row per tick and a column per channel.

    Args:
        samples: All channels of a run, shape (ticks, channels).
        attributes: Law, fault and other facts of the run, for the attributes.

    Returns:
        The frame; its `attrs` have `attributes` and the unit of each channel.

    Raises:
        MissingExtraError: If pandas, of the extra of that name, is not installed.
    """
    require_extra("pandas")
    import pandas

    table = pandas.DataFrame(samples, columns=list(CHANNEL_NAMES))
    table.attrs.update(attributes, units={channel.name: channel.unit for channel in CHANNELS})
    return table


def build_dataset(samples: np.ndarray, attributes: Mapping[str, str]) -> "xarray.Dataset":
    """Build a variable per channel along `time_s`, each with `units` and `long_name`.

    Raises:
        MissingExtraError: If xarray, of the extra of that name, is not installed.
    """
    require_extra("xarray")
    import xarray

    columns = zip(CHANNELS, samples.T, strict=True)
    variables = {
        channel.name: ((TIME,), values, {"units": channel.unit, "long_name": channel.label})
        for channel, values in columns
    }
    time = variables.pop(TIME)
    return xarray.Dataset(variables, coords={TIME: time}, attrs=dict(attributes))

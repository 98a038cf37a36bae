"""A result as a table of pandas and as a dataset of xarray, with units in the attributes."""

import json
from typing import TYPE_CHECKING, Any

import pandas

from svsa.extras import require_extra
from svsa.signals import CHANNEL_NAMES, CHANNELS

if TYPE_CHECKING:
    import xarray

    from svsa.result.result import Result

TIME = "time_s"


def build_dataframe(result: "Result") -> pandas.DataFrame:
    """A row a tick, a column a channel; `attrs` has the units and what the run was."""
    table = pandas.DataFrame(result.samples, columns=list(CHANNEL_NAMES))
    table.attrs.update(_describe(result), units=result.units)
    return table


def build_dataset(result: "Result") -> "xarray.Dataset":
    """A variable a channel along `time_s`, each with `units` and `long_name`.

    Raises `MissingExtraError` where xarray, of the extra of that name, is not installed.
    """
    require_extra("xarray")
    import xarray

    columns = zip(CHANNELS, result.samples.T, strict=True)
    variables = {
        channel.name: ((TIME,), values, {"units": channel.unit, "long_name": channel.label})
        for channel, values in columns
    }
    time = variables.pop(TIME)
    return xarray.Dataset(variables, coords={TIME: time}, attrs=_describe(result))


def _describe(result: "Result") -> dict[str, Any]:
    """What every format of a file can hold: texts, and no value of None."""
    configuration = result.configuration.model_dump(mode="json")
    told = {"law": result.law, "configuration": json.dumps(configuration)}
    if result.name:
        told["name"] = result.name
    if result.fault is not None:
        told["fault"] = result.fault.message
    return told

"""Label and unit of a setting, from its field's declaration."""

from typing import NamedTuple

from svsa.control.installed import get_title
from svsa.evaluation.studies.setting import ACTUATOR, Step, parse_path, walk_to_setting
from svsa.evaluation.studies.variation import Variation
from svsa.inputs.checked import Checked, read_quantity
from svsa.runs.definition.configuration import Configuration

_SCALED = {
    "position_bandwidth_rad_per_s": "Bandwidth of the position error",
    "stiffness_bandwidth_rad_per_s": "Bandwidth of the stiffness error",
}
_ANGULAR = "rad/s"


class SettingName(NamedTuple):
    """Name of a setting.

    Attributes:
        words: Text such as "Output link inertia M".
        unit: Unit; empty for a factor or without a unit.
    """

    words: str
    unit: str


def name_variation(base: Configuration, variation: Variation) -> SettingName:
    """Name a varied setting; a relative one as a factor."""
    name = name_setting(base, variation.path)
    return SettingName(f"{name.words}, factor", "") if variation.relative else name


def name_setting(configuration: Configuration, path: str) -> SettingName:
    """Name the setting at a path.

    The name contains "Nominal" for the controllers' model, the law of a law's parameter, and the
    number of a load if there are several.

    Raises:
        ParameterError: If there is no such setting.
    """
    if path == ACTUATOR:
        return SettingName("Mechanism", "")
    words, unit, parts = path, "", []
    for owner, step, _ in walk_to_setting(configuration, path):
        if step in _SCALED:
            words, unit = _SCALED[step], _ANGULAR
        elif isinstance(owner, Checked):
            field = read_quantity(type(owner), str(step))
            words, unit, parts = field.symbol or field.meaning, field.unit, field.parts
        elif isinstance(step, int) and step < len(parts):
            words = parts[step]
    whose = _describe_owner(configuration, parse_path(path))
    return SettingName(whose + words, "" if unit == "1" else unit)


def _describe_owner(configuration: Configuration, steps: tuple[Step, ...]) -> str:
    first, *rest = steps
    if first == "nominal" and rest:
        return "Nominal: "
    if first == "parameters" and rest:
        return f"{get_title(str(rest[0]))}: "
    if first == "loads" and rest and len(configuration.loads) > 1:
        return f"{int(rest[0]) + 1}: "
    return ""

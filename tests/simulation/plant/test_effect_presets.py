"""The presets of non-ideal effects: their effects, and the name of a selection."""

import pytest

from svsa.simulation.plant.effects import (
    EVERY,
    IDEAL,
    PRESETS,
    RIG,
    Effects,
    find_preset,
)
from svsa.simulation.plant.effects.noise import SensorNoise


@pytest.mark.parametrize("name", PRESETS)
def test_preset_is_recognized(name: str) -> None:
    assert find_preset(PRESETS[name]) == name


def test_preset_is_recognized_with_changed_values() -> None:
    assert find_preset(EVERY.changed(noise=SensorNoise(motor_std_rad=1e-4))) == "full"


@pytest.mark.parametrize(
    "effects",
    [
        RIG.changed(delay_samples=2),
        RIG.changed(noise=SensorNoise()),
        EVERY.changed(gravity=None),
        IDEAL.changed(torque_limits=False),
    ],
)
def test_other_selection_is_custom(effects: Effects) -> None:
    assert find_preset(effects) is None

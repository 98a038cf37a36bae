"""Validation of integers, booleans, and values of several types."""

from typing import Any

import pytest
from pydantic import TypeAdapter

from svsa.errors import ParameterError
from svsa.simulation.plant.effects import Effects
from svsa.simulation.plant.effects.delay_samples import MAX_DELAY_SAMPLES
from svsa.simulation.plant.loads import Load
from svsa.simulation.reference.kinds import PositionReference, StiffnessReference


@pytest.mark.parametrize("given", [3, 3.0])
def test_float_without_fraction_is_an_integer(given: float) -> None:
    effects = Effects(delay_samples=given)
    assert effects.delay_samples == 3
    assert type(effects.delay_samples) is int


@pytest.mark.parametrize("given", [True, "3", 2.5, 1e300, float("nan"), float("inf"), None])
def test_other_values_are_not_integers(given: Any) -> None:
    with pytest.raises(ParameterError, match=r"delay_samples.*an integer"):
        Effects(delay_samples=given)


def test_float_integer_keeps_its_bounds() -> None:
    with pytest.raises(ParameterError, match=r"delay_samples is 6.*: it must be at most 5 "):
        Effects(delay_samples=6.0)


def test_schema_contains_the_bounds_of_an_integer() -> None:
    said = Effects.model_json_schema()["properties"]["delay_samples"]
    assert (said["type"], said["minimum"], said["maximum"]) == ("integer", 0, MAX_DELAY_SAMPLES)


@pytest.mark.parametrize("given", [1, 0.0, "yes", "true"])
def test_only_true_and_false_are_booleans(given: Any) -> None:
    with pytest.raises(ParameterError, match=r"torque_limits.*true or false"):
        Effects(torque_limits=given)


@pytest.mark.parametrize("union", [PositionReference, StiffnessReference, Load])
def test_schema_requires_the_requested_kind(union: Any) -> None:
    assert TypeAdapter(union).json_schema()["required"] == ["kind"]


def test_unchanged_value_is_the_same_object() -> None:
    effects = Effects(delay_samples=1)
    assert effects.changed(delay_samples=1) is effects
    assert effects.changed(delay_samples=2) == Effects(delay_samples=2)
    with pytest.raises(ParameterError, match="delay_samples"):
        effects.changed(delay_samples=True)
    with pytest.raises(ParameterError, match="no_such_field"):
        effects.changed(no_such_field=1)

"""The guided zero: one mark after the other, each confirmed by a user."""

import pytest

from svsa.errors import ParameterError, StateError
from svsa.hardware.bench.homing import DONE, STEPS, Homing, get_instruction


def test_marks_are_confirmed_in_order_with_the_user():
    homing, seen = Homing(), []
    while (step := homing.next_step) is not None:
        seen.append(step)
        assert get_instruction(step) == next(s.instruction for s in STEPS if s.name == step)
        homing.confirm(step, "Ada")
    assert seen == ["link", "motor1", "motor2"]
    assert homing.confirmed == dict.fromkeys(seen, "Ada")
    assert get_instruction(homing.next_step) == DONE


@pytest.mark.parametrize("step", ["motor1", "motor2"])
def test_mark_is_not_confirmed_out_of_order(step):
    """The spring is relaxed at the link's mark: the motors' zeros are undefined before."""
    homing = Homing()
    with pytest.raises(StateError, match="link"):
        homing.confirm(step, "Ada")
    assert homing.next_step == "link"


def test_mark_is_not_confirmed_twice_nor_after_the_last():
    homing = Homing()
    homing.confirm("link", "Ada")
    with pytest.raises(StateError, match="motor 1"):
        homing.confirm("link", "Bob")
    homing.confirm("motor1", "Ada")
    homing.confirm("motor2", "Ada")
    with pytest.raises(StateError, match="nothing is left"):
        homing.confirm("motor2", "Bob")
    assert homing.confirmed["link"] == "Ada"


def test_unknown_mark_or_missing_user_is_rejected():
    homing = Homing()
    with pytest.raises(ParameterError, match="one of link, motor1, motor2"):
        homing.confirm("elbow", "Ada")
    with pytest.raises(ParameterError, match="the user who checked"):
        homing.confirm("link", "  ")
    assert homing.confirmed == {}


def test_reset_of_the_drives_discards_all_marks():
    homing = Homing()
    homing.confirm("link", "Ada")
    homing.reset()
    assert homing.next_step == "link"

"""The table of faults: codes and numbers that records contain, and the advice for each."""

import pytest

from svsa.actuators import domain
from svsa.actuators.faults import (
    ALLOWED_TORQUE,
    FAULT_CODES,
    FAULTS,
    LOSSES,
    advise,
    find_number,
    label_fault,
)

VALUES = {"deflection_rad": 0.012, "motor2_position_rad": 1.09}


def test_numbers_of_compiled_code_are_those_of_all_records() -> None:
    assert FAULT_CODES == {
        1: "not_finite",
        2: "lever_end",
        3: "deflection_limit",
        4: "singular_decoupling",
    }
    assert domain.INSIDE not in FAULT_CODES
    assert {code: kind.where for code, kind in FAULTS.items() if kind.number is not None} == (
        dict.fromkeys(FAULT_CODES.values(), "both")
    )
    with pytest.raises(LookupError):
        find_number("quick_stop")


def test_run_that_leaves_the_domain_of_the_model_has_advice() -> None:
    assert all(FAULTS[code].advice for code in FAULT_CODES.values())
    assert "stiffer setting" in str(advise("lever_end", VALUES))


@pytest.mark.parametrize("code", ["lever_end", "implausible"])
@pytest.mark.parametrize("limit", [f"motor2{ALLOWED_TORQUE}", "motor2_held_to_nm"])  # now, 0.1.0
def test_heat_limit_of_a_motor_is_the_reason_of_any_fault(code: str, limit: str) -> None:
    warm = VALUES | {"motor2_heat": 1.0, "motor2_commanded_nm": 5.0, limit: 1.27}
    advice = str(advise(code, warm))
    assert "Let the motor cool" in advice
    assert "stiffer setting" not in advice


def test_unknown_fault_of_a_newer_record_has_its_code_as_label() -> None:
    assert label_fault("gear_broken") == "Gear broken"
    assert advise("gear_broken", {}) is None


def test_losses_of_a_loop_are_faults_of_a_bench() -> None:
    assert {FAULTS[code].where for code in LOSSES} == {"bench"}
    assert set(LOSSES) == {
        "bench_not_opened",
        "loop_silent",
        "loop_lost",
        "loop_and_supervisor_lost",
    }

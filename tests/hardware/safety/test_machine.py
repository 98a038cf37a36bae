"""The states of a bench: every call in every state, and the result of each condition."""

import math
from typing import Any

import pytest

from svsa.actuators.faults import FAULTS
from svsa.actuators.signals import Torque
from svsa.errors import ParameterError, StateError
from svsa.hardware.bench.homing import STEPS
from svsa.hardware.description.file import read_bench
from svsa.hardware.drives.phase import Phase
from svsa.hardware.realtime.configuration import build_guard
from svsa.hardware.safety.faults import Alarm
from svsa.hardware.safety.machine import BenchStatus, Conditions, Machine
from tests.hardware.wired_bench import AT_REST, EMULATOR_BENCH, UNDISTURBED

BENCH = read_bench(EMULATOR_BENCH)
FINE = Conditions(Phase.READY, (0.001, 0.001, 0.001), None, 0, 0.0, 0.0)
PUSH = Torque(1.0, 0.5)
ALL = list(BenchStatus)


def build(**safety: Any) -> Machine:
    bench = BENCH.changed(safety=BENCH.safety.changed(**safety))
    return Machine(bench, build_guard(bench), [])


def update(machine: Machine, **changes: Any) -> Torque:
    return machine.update(FINE._replace(**changes), PUSH, AT_REST, UNDISTURBED)


def bring(status: BenchStatus, **safety: Any) -> Machine:
    """Bring a machine to this state, by its transitions."""
    machine = build(**safety)
    if status is BenchStatus.FAULT:
        machine.fail(Alarm("bus_error", "a test", {}))
    elif status is not BenchStatus.OFF:
        machine.arm()
        for phase in (Phase.RESET, Phase.CONFIG, Phase.MODE, Phase.READY):
            if machine.status is status:
                break
            update(machine, phase=phase)
        if status in (BenchStatus.RUN, BenchStatus.RAMP):
            for step in STEPS:
                machine.confirm_home(step.name, "a test")
            machine.start(0.0)
        if status is BenchStatus.RAMP:
            machine.stop()
    assert machine.status is status
    return machine


def is_refused(status: BenchStatus, call: str, *arguments: Any) -> bool:
    machine = bring(status)
    try:
        getattr(machine, call)(*arguments)
    except StateError as error:
        assert str(error).startswith("The bench is") or "zero mark" in str(error)
        assert machine.status is status, "a refused call changes nothing"
        return True
    return False


def test_each_state_accepts_its_permitted_calls_only() -> None:
    takes = {
        call: {status for status in ALL if not is_refused(status, call, *arguments)}
        for call, arguments in {
            "arm": (),
            "confirm_home": ("link", "a test"),
            "start": (0.0,),
            "stop": (),
            "clear": (),
        }.items()
    }
    assert takes == {
        "arm": {BenchStatus.OFF, BenchStatus.READY},
        "confirm_home": {BenchStatus.READY},
        "start": set(),
        "stop": set(ALL),
        "clear": {BenchStatus.FAULT},
    }, "start needs the marks as well"


@pytest.mark.parametrize("status", ALL)
def test_torque_is_sent_in_run_and_ramp_only(status: BenchStatus) -> None:
    phase = Phase(status) if status in Phase else Phase.READY
    torque = update(bring(status), phase=phase)
    assert (torque != (0.0, 0.0)) == (status in (BenchStatus.RUN, BenchStatus.RAMP))


@pytest.mark.parametrize("status", ALL)
def test_stop_leaves_run_only(status: BenchStatus) -> None:
    machine = bring(status)
    machine.stop()
    assert machine.status is (BenchStatus.RAMP if status is BenchStatus.RUN else status)


def test_problems_prevent_arming() -> None:
    machine = Machine(BENCH, build_guard(BENCH), ["uncalibrated: this", "uncalibrated: that"])
    with pytest.raises(StateError, match="uncalibrated: this; uncalibrated: that"):
        machine.arm()


def test_arming_again_requires_the_marks_again() -> None:
    machine = bring(BenchStatus.RAMP)
    while machine.status is BenchStatus.RAMP:
        update(machine)
    assert machine.homing.next_step is None
    machine.arm()
    assert machine.homing.next_step == STEPS[0].name
    machine.stop()
    assert machine.status is BenchStatus.RESET


@pytest.mark.parametrize("by", ["", "  "])
def test_mark_is_confirmed_by_a_user(by: str) -> None:
    with pytest.raises(ParameterError, match="by"):
        bring(BenchStatus.READY).confirm_home("link", by)


CONDITIONS = {
    "bus_error": {"alarm": Alarm("bus_error", "a test", {})},
    "drive_silent": {"phase": Phase.SILENT},
    "stale_feedback": {"ages_s": (0.001, 0.0201, 0.001)},
    "missed_ticks": {"missed": 20},
    "loop_late": {"late_s": 0.05, "missed": 50, "alarm": Alarm("foreign_command", "a test", {})},
    "supervisor_lost": {"supervisor_age_s": 0.0501},
}
UNWATCHED = (BenchStatus.OFF, BenchStatus.FAULT)
ARMING = (BenchStatus.RESET, BenchStatus.CONFIG, BenchStatus.MODE)


@pytest.mark.parametrize("code", CONDITIONS)
@pytest.mark.parametrize("status", [status for status in ALL if status is not BenchStatus.FAULT])
def test_each_condition_is_a_fault_in_its_states(status: BenchStatus, code: str) -> None:
    machine = bring(status)
    phase = Phase(status) if status in Phase else Phase.READY
    assert update(machine, **{"phase": phase} | CONDITIONS[code]) is not None
    own = status in ARMING and code not in ("bus_error", "drive_silent", "loop_late")
    if status in UNWATCHED or own:
        assert machine.fault is None
        return
    assert machine.status is BenchStatus.FAULT
    assert machine.fault is not None
    assert machine.fault.code == code
    assert code in FAULTS


@pytest.mark.parametrize(
    ("conditions", "torque"),
    [
        ({"ages_s": (0.0049, 0.001, 0.001)}, True),
        ({"ages_s": (0.0051, 0.001, 0.001)}, False),
        ({"ages_s": (0.001, 0.0199, 0.001)}, False),
        ({"ages_s": (0.001, 0.001, 0.0051)}, False),
        ({"missed": 19}, True),
        ({"supervisor_age_s": 0.0499}, True),
    ],
)
def test_run_continues_just_within_the_bounds(conditions: Any, torque: bool) -> None:
    machine = bring(BenchStatus.RUN)
    assert (update(machine, **conditions) != (0.0, 0.0)) == torque
    assert machine.status is BenchStatus.RUN


def test_axis_without_feedback_is_a_fault_with_finite_values() -> None:
    machine = bring(BenchStatus.READY)
    update(machine, ages_s=(0.001, 0.001, math.inf))
    assert machine.fault is not None
    assert machine.fault.code == "stale_feedback"
    assert all(math.isfinite(value) for value in machine.fault.values.values())


def test_late_loop_reports_its_delay_and_the_action_of_the_supervisor() -> None:
    machine = bring(BenchStatus.RUN)
    update(machine, late_s=0.05)
    assert machine.fault is not None
    assert "50 ms late" in machine.fault.message
    assert "supervisor" in machine.fault.message
    assert machine.fault.values == {"late_s": 0.05, "supervisor_waits_s": 0.02}
    machine = bring(BenchStatus.RUN)
    update(machine, late_s=0.0)
    assert machine.fault is not None
    assert machine.fault.values["late_s"] == 0.02, "it was late by what the supervisor waits"


def test_ended_supervisor_is_reported_with_finite_values() -> None:
    machine = bring(BenchStatus.RUN)
    update(machine, supervisor_age_s=math.inf)
    assert machine.fault is not None
    assert (machine.fault.code, machine.fault.values) == ("supervisor_lost", {})
    assert "its process has ended" in machine.fault.message


def test_silence_of_the_operator_ramps_down_only_if_a_switch_is_required() -> None:
    machine = bring(BenchStatus.RUN)
    update(machine, operator_age_s=math.inf)
    assert machine.status is BenchStatus.RUN
    machine = bring(BenchStatus.RUN, dead_man=True)
    update(machine, operator_age_s=0.0999)
    assert machine.status is BenchStatus.RUN
    update(machine, operator_age_s=0.1001)
    assert machine.status is BenchStatus.RAMP


def test_fault_has_the_time_of_its_run() -> None:
    machine = bring(BenchStatus.RUN)
    for _ in range(250):
        update(machine)
    machine.fail(Alarm("bus_error", "first", {}))
    machine.fail(Alarm("overspeed", "second", {}))
    assert machine.fault is not None
    assert (machine.fault.code, machine.fault.tick) == ("bus_error", 250)
    assert machine.fault.time_s == pytest.approx(0.25)


def test_every_fault_of_a_bench_has_a_label() -> None:
    labels = [kind.label for kind in FAULTS.values()]
    assert all(0 < len(label) < 26 and "_" not in label for label in labels)
    assert len(set(labels)) == len(labels)


def test_ramp_has_its_duration_with_any_missed_ticks() -> None:
    machine = bring(BenchStatus.RAMP, missed_ticks=1000)
    update(machine, missed=199)
    assert machine.status is BenchStatus.RAMP, "0.2 of 0.3 s"
    update(machine, missed=98)
    assert machine.status is BenchStatus.RAMP
    update(machine)
    assert machine.status is BenchStatus.READY


BEYOND = (
    ("overspeed", AT_REST._replace(dq=26.0)),
    ("overspeed", AT_REST._replace(dtheta2=31.0)),
    ("position_limit", AT_REST._replace(q=2.6)),
    ("position_limit", AT_REST._replace(theta1=-2.8)),
)


@pytest.mark.parametrize("known", BEYOND, ids=str)
@pytest.mark.parametrize("status", [each for each in ALL if each is not BenchStatus.FAULT])
def test_position_and_speed_are_limited_in_every_state_but_off(status, known) -> None:
    """A load moves the mechanism without torque as well."""
    machine = bring(status)
    code, state = known
    machine.update(FINE._replace(phase=Phase.MODE), PUSH, state, UNDISTURBED)
    if status is BenchStatus.OFF:
        assert machine.fault is None
    else:
        assert machine.fault is not None and machine.fault.code == code

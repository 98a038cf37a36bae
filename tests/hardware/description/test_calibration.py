"""The calibration record is valid for its bench only."""

from datetime import datetime

import pytest

from svsa.errors import ParameterError, StateError
from svsa.hardware.bench.homing import STEPS, Homing
from svsa.hardware.commissioning.zero import calibrate, read_deflection_zero
from svsa.hardware.description.calibration import (
    Calibration,
    compute_fingerprint,
    find_calibration,
    get_calibration_path,
    list_problems,
    note_signs,
    write_calibration,
)
from svsa.hardware.description.file import read_bench
from svsa.hardware.drives.bus import BusError
from svsa.hardware.emulator.emulator import Emulator
from svsa.hardware.emulator.faults import DropFrames
from svsa.hardware.emulator.parameters import EmulatedDeflection, EmulatorParameters
from svsa.hardware.encoders.source import EncoderError
from svsa.simulation.plant.loads.constant import ConstantLoad
from tests.hardware.emulator.bus_in_time import EMULATOR_BENCH, EmulatorBus, copy_bench

MOTOR_CHANGES = [
    ("gear_ratio = 50.0", "gear_ratio = 51.0"),
    ("sign = 1", "sign = -1"),
    ("counts_per_rev = 8000", "counts_per_rev = 4000"),
    ("lever_ratio = 0.6", "lever_ratio = 0.5"),
    ("id = 0x700", "id = 0x701"),
]


@pytest.fixture
def bench(tmp_path):
    """The emulator's bench without its record."""
    path = copy_bench(tmp_path)
    path.with_name("bench.calibration.toml").unlink()
    return read_bench(path)


def build(bench, **changes):
    made = {
        "date": "2026-01-02T03:04:05+01:00",
        "by": "Ada",
        "fingerprint": compute_fingerprint(bench),
        "deflection_zero_counts": -17,
        "signs_confirmed": True,
    }
    return Calibration(**(made | changes))


def confirm_all(by="Ada"):
    homing = Homing()
    for step in STEPS:
        homing.confirm(step.name, by)
    return homing


def test_record_is_read_as_written(bench):
    path = write_calibration(bench, build(bench))
    assert path == get_calibration_path(bench)
    assert path.name == "bench.calibration.toml"
    assert find_calibration(bench) == build(bench)
    assert list_problems(bench, build(bench)) == []
    assert [each.name for each in path.parent.iterdir() if each.suffix == ".tmp"] == []


def test_missing_record_reports_what_to_run(bench):
    assert find_calibration(bench) is None
    (problem,) = list_problems(bench, None)
    assert "bench-home" in problem


@pytest.mark.parametrize(("old", "new"), MOTOR_CHANGES)
def test_change_of_motor_encoder_or_mark_invalidates_the_record(tmp_path, bench, old, new):
    calibration = build(bench)
    changed = read_bench(copy_bench(tmp_path, lambda text: text.replace(old, new, 1)))
    (problem,) = list_problems(changed, calibration)
    assert "changed after the calibration of 2026-01-02" in problem


def test_unrelated_change_keeps_the_record_valid(tmp_path, bench):
    """Another adapter or a narrower limit needs no new zero."""
    changed = read_bench(
        copy_bench(
            tmp_path,
            lambda text: text.replace("29536", "1").replace("max_nm = 12.0", "max_nm = 9.0"),
        )
    )
    assert list_problems(changed, build(bench)) == []


def test_unconfirmed_signs_and_missing_values_prevent_arming(tmp_path, bench):
    (problem,) = list_problems(bench, build(bench, signs_confirmed=False))
    assert "bench-check --move" in problem
    unknown = read_bench(copy_bench(tmp_path, lambda text: text.replace("efficiency = 0.9", "", 1)))
    words = "uncalibrated: motor 1 has no efficiency: motor1.efficiency is not given"
    assert list_problems(unknown, build(unknown))[0] == words


@pytest.mark.parametrize(
    "text",
    [
        "by = ",
        "by = 'Ada'\n",
        "\xff",
        "date = '2026-01-02T03:04:05'\nby = 'A'\nfingerprint = ''\n"
        "deflection_zero_counts = 0\nsigns_confirmed = true\n",
        "date = 'yesterday'\nby = 'A'\nfingerprint = ''\n"
        "deflection_zero_counts = 0\nsigns_confirmed = true\n",
        "date = '2026-01-02T03:04:05Z'\nby = ''\nfingerprint = ''\n"
        "deflection_zero_counts = 0.5\nsigns_confirmed = true\n",
    ],
    ids=["no TOML", "fields missing", "no UTF-8", "no zone", "no date", "wrong values"],
)
def test_damaged_record_is_rejected(bench, text):
    get_calibration_path(bench).write_bytes(text.encode("latin-1"))
    with pytest.raises(ParameterError):
        find_calibration(bench)


def test_signs_are_stored_in_a_record_of_this_bench_only(bench):
    note_signs(bench, True)
    assert find_calibration(bench) is None
    write_calibration(bench, build(bench, signs_confirmed=False))
    note_signs(bench, True)
    assert find_calibration(bench) == build(bench)
    stranger = build(bench, fingerprint="another", signs_confirmed=False)
    write_calibration(bench, stranger)
    note_signs(bench, True)
    assert find_calibration(bench) == stranger


def test_record_of_the_rig_fits_its_bench_file():
    """Otherwise `svsa emulator` and the figures through CAN would not arm."""
    bench = read_bench(EMULATOR_BENCH)
    assert list_problems(bench, find_calibration(bench)) == []


def test_calibration_stores_the_zero_with_user_and_time(bench):
    bus = EmulatorBus(
        Emulator(
            EmulatorParameters(deflection=EmulatedDeflection(offset_counts=-321, phase_s=0.0008))
        )
    )
    path, calibration = calibrate(bench, confirm_all(" Ada "), bus.open, bus.now)
    assert (calibration.deflection_zero_counts, calibration.by) == (-321, "Ada")
    assert datetime.fromisoformat(calibration.date).tzinfo is not None
    assert not calibration.signs_confirmed
    assert find_calibration(bench) == calibration
    assert path.exists()
    assert bus.sent == []
    assert not bus.is_open


def test_new_calibration_keeps_signs_confirmed_for_these_settings(bench):
    write_calibration(bench, build(bench))
    bus = EmulatorBus()
    assert calibrate(bench, confirm_all(), bus.open, bus.now)[1].signs_confirmed
    write_calibration(bench, build(bench, fingerprint="another"))
    assert not calibrate(bench, confirm_all(), bus.open, bus.now)[1].signs_confirmed


def test_nothing_is_written_before_every_mark_is_confirmed(bench):
    homing, bus = Homing(), EmulatorBus()
    homing.confirm("link", "Ada")
    with pytest.raises(StateError, match="Motor 1 has not"):
        calibrate(bench, homing, bus.open, bus.now)
    assert find_calibration(bench) is None


def test_oscillating_link_is_not_taken_for_a_zero(bench):
    bus = EmulatorBus()
    bus.emulator.add_load(ConstantLoad(torque_nm=(0.5, 0.0, 0.0)))
    with pytest.raises(StateError, match="release the link"):
        calibrate(bench, confirm_all(), bus.open, bus.now)
    assert find_calibration(bench) is None


def test_silent_encoder_and_missing_bus_have_no_zero(bench):
    bus = EmulatorBus()
    bus.emulator.inject(DropFrames(node="deflection"))
    with pytest.raises(EncoderError, match="bench-check"):
        read_deflection_zero(bench, bus.open, bus.now)
    assert not bus.is_open

    def reject(settings):
        raise BusError("no adapter")

    with pytest.raises(BusError):
        read_deflection_zero(bench, reject, bus.now)

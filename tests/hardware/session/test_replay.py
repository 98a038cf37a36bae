"""The record of a bench contains all that is needed to verify it from its measurements."""

import dataclasses
import math
from pathlib import Path

import numpy as np
import pytest

from svsa.actuators.signals import CHANNEL_INDEX
from svsa.control.observers.disturbance import ObserverBandwidth
from svsa.hardware.session.replay import Verified, verify_bench_record
from svsa.runs.definition.command import Set
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.paper import get_figure
from svsa.runs.records.bench_start import START_FILE, BenchStart
from svsa.runs.records.export.formats import export
from svsa.runs.records.header import RecordError
from svsa.runs.records.parquet import unpack_parquet
from svsa.runs.records.reader import open_record
from tests.hardware.session.recorded_bench import run_bench, write_bench_record

TICKS, MISSED_AT, MISSED = 900, 300, 7
SLOWER = Set("observer", ObserverBandwidth(bandwidth_rad_per_s=(40.0, 40.0, 40.0)))
TO_ESP = Set("law", "esp", tick=600)
COUNT_RAD = 2.0 * math.pi / 8000
RESIDUALS = [CHANNEL_INDEX[name] for name in CHANNEL_INDEX if "residual" in name]
Run = tuple[Configuration, np.ndarray, BenchStart]


@pytest.fixture(scope="module")
def run() -> Run:
    wanted = get_figure("4a").build_configuration(load=False)
    late = {0: 3, MISSED_AT: MISSED}
    return run_bench(wanted, TICKS, before=[SLOWER], later=[TO_ESP], late=late)


def verify(folder: Path, run: Run, commands: tuple = (SLOWER, TO_ESP)) -> Verified:
    write_bench_record(folder / "run-1", run, commands)
    return verify_bench_record(open_record(folder / "run-1"))


def test_every_number_follows_from_measured_and_sent_values(run: Run, tmp_path: Path) -> None:
    """Also with missed ticks, before and during the run, and after a change of law."""
    found = verify(tmp_path, run)
    assert (found.plant, found.ticks, found.missed, found.lanes) == ("emulated", TICKS, MISSED, 1)
    assert found.share_as_limited > 0.9
    assert "an emulator" in found.description
    assert "7 of them were missed" in found.description


WORKED_OUT = ("position_rad", "estimate_link_nm", "position_error_rad", "stiffness_nm_per_rad")


@pytest.mark.parametrize(
    ("lane", "channel"), [(0, one) for one in WORKED_OUT] + [(1, "torque1_nm")]
)
def test_one_different_bit_is_found(run: Run, tmp_path: Path, lane: int, channel: str) -> None:
    configuration, samples, start = run
    changed = samples.copy()
    changed.view(np.uint64)[lane, 700, CHANNEL_INDEX[channel]] ^= 1
    with pytest.raises(RecordError, match=rf"\.{channel} differs at tick 700"):
        verify(tmp_path, (configuration, changed, start))


@pytest.mark.parametrize(
    ("channel", "by"),
    [("deflection_rad", COUNT_RAD), ("motor1_position_rad", COUNT_RAD), ("torque1_nm", 0.01)],
)
def test_changed_count_or_torque_is_found(
    run: Run, tmp_path: Path, channel: str, by: float
) -> None:
    """They are inputs; the values computed from them are not."""
    configuration, samples, start = run
    changed = samples.copy()
    changed[0, 700, CHANNEL_INDEX[channel]] += by
    with pytest.raises(RecordError, match=r"differs at tick 70[01]"):
        verify(tmp_path, (configuration, changed, start))


def test_other_start_is_found(run: Run, tmp_path: Path) -> None:
    configuration, samples, start = run
    motion = start.motion | {"known": [0.0, 0.01, 0.0, 0.0, 0.0, 0.0]}
    other = dataclasses.replace(start, motion=motion)
    with pytest.raises(RecordError, match="differs at tick 0"):
        verify(tmp_path, (configuration, samples, other))


def test_missing_or_delayed_command_is_found(run: Run, tmp_path: Path) -> None:
    for number, commands in enumerate([(SLOWER,), (SLOWER, TO_ESP.at(601))]):
        with pytest.raises(RecordError, match="does not follow"):
            verify(tmp_path / str(number), run, commands)


def test_wrong_gains_are_found(tmp_path: Path) -> None:
    """Without a twin the torques reveal them, for all other values follow from any torque."""
    wanted = get_figure("4a").build_configuration("fl", load=False)
    configuration, samples, start = run_bench(wanted, 200)
    alone = samples[:1].copy()
    alone[:, :, RESIDUALS] = 0.0
    reported = configuration.changed(comparisons=())
    assert verify(tmp_path / "own", (reported, alone, start), ()).lanes == 0
    poles = reported.gains.position_coefficients
    gains = reported.gains.changed(position_coefficients=(0.5 * poles[0], *poles[1:]))
    with pytest.raises(RecordError, match="was not controlled by its law: at tick"):
        verify(tmp_path / "other", (reported.changed(gains=gains), alone, start), ())


def test_law_with_measured_values_is_verified(tmp_path: Path) -> None:
    wanted = get_figure("4a").build_configuration("pi_observer", load=False)
    run = run_bench(wanted, 300, later=[], late={100: 3})
    assert verify(tmp_path, run, ()).share_as_limited > 0.9


def test_record_without_its_initial_state_is_rejected(run: Run, tmp_path: Path) -> None:
    verify(tmp_path, run)
    (tmp_path / "run-1" / START_FILE).unlink()
    with pytest.raises(RecordError, match="nothing of it can be verified"):
        verify_bench_record(open_record(tmp_path / "run-1"))


def test_exported_run_can_be_verified_elsewhere(run: Run, tmp_path: Path) -> None:
    verify(tmp_path, run)
    export(open_record(tmp_path / "run-1"), "parquet", tmp_path / "run.parquet")
    unpack_parquet((tmp_path / "run.parquet").read_bytes(), tmp_path / "elsewhere")
    assert verify_bench_record(open_record(tmp_path / "elsewhere")).ticks == TICKS

"""Records of versions with fewer or more channels open, plot, replay, verify and compare."""

import shutil
from pathlib import Path

import numpy as np
import pytest

import svsa
from svsa.actuators.signals import CHANNEL_INDEX, CHANNEL_NAMES, Channel
from svsa.hardware.session.replay import verify_bench_record
from svsa.runs.records.header import PARQUET_FILE, RecordError, write_header
from svsa.runs.records.parquet import write_parquet
from svsa.runs.records.reader import open_record
from svsa.runs.records.stream import build_batch, build_schema
from svsa.runs.records.writer import write_record
from tests.lab_in_process import run_lab_in_process
from tests.waiting import wait_until

RECORDS = Path(__file__).parents[2] / "data" / "records"
NAMES = ("simulated", "comparisons", "bench")
ADDED = Channel("power1_w", "W", "Mechanical power of motor 1")
MISSING = "velocity_estimate_rad_per_s"


def rewrite(name: str, folder: Path, *, added: Channel | None = None, missing: str = "") -> Path:
    """Copy a record as a version with another set of channels would have written it."""
    record = open_record(RECORDS / name)
    channels = [channel for channel in record.header.channels if channel.name != missing]
    samples = record.read_channels([channel.name for channel in channels])
    if added:
        channels.insert(3, added)  # not at the end: nothing may depend on the order
        samples = np.insert(samples, 3, 1.0, axis=2)
    header = record.header.model_copy(update={"channels": tuple(channels)})
    shutil.copytree(RECORDS / name, folder)
    write_header(folder, header)
    batch = build_batch(header, build_schema(header), record.first_tick, samples)
    with (folder / PARQUET_FILE).open("wb") as file:
        write_parquet(file, header, record.commands, [batch])
    return folder


def list_later(name: str) -> set[str]:
    """List the channels that this version has and the one that wrote the record had not."""
    return {*CHANNEL_NAMES} - {*open_record(RECORDS / name).header.channel_names}


def verify(folder: Path) -> set[str]:
    """Verify a record, and return the channels that were not compared."""
    record = open_record(folder)
    if record.start is not None:
        verified = verify_bench_record(record)
        assert all(name in verified.description for name in verified.not_compared)
        return {*verified.not_compared}
    compared = svsa.resimulate(folder)
    assert compared.identical, compared.first_difference
    assert compared.ticks == record.tick_count > 0
    return {*compared.not_compared}


@pytest.mark.long
@pytest.mark.parametrize("name", NAMES)
def test_missing_channel_is_not_a_number(name: str, tmp_path: Path) -> None:
    folder = rewrite(name, tmp_path / "run-1", missing=MISSING)
    opened, original = svsa.open_run(folder), svsa.open_run(RECORDS / name)
    for lane, other in zip(
        (opened, *opened.comparisons), (original, *original.comparisons), strict=True
    ):
        assert np.isnan(lane[MISSING]).all()
        assert np.isfinite(other[MISSING]).any()
        rest = [CHANNEL_INDEX[channel] for channel in CHANNEL_NAMES if channel != MISSING]
        np.testing.assert_array_equal(lane.samples[:, rest], other.samples[:, rest])
    assert verify(folder) == {MISSING, *list_later(name)}


@pytest.mark.long
@pytest.mark.parametrize("name", NAMES)
def test_unknown_channel_is_ignored(name: str, tmp_path: Path) -> None:
    folder = rewrite(name, tmp_path / "run-1", added=ADDED)
    opened, original = svsa.open_run(folder), svsa.open_run(RECORDS / name)
    np.testing.assert_array_equal(opened.samples, original.samples)
    assert verify(folder) == {ADDED.name, *list_later(name)}


@pytest.mark.parametrize("name", NAMES)
def test_verdict_compares_common_channels_and_names_the_rest(name: str, tmp_path: Path) -> None:
    older = rewrite(name, tmp_path / "older", missing=MISSING)
    newer = rewrite(name, tmp_path / "newer", added=ADDED)
    verdict = svsa.compare_runs(older, newer)
    assert verdict.held
    assert sorted(verdict.not_compared) == sorted([MISSING, ADDED.name])
    common = {*CHANNEL_NAMES} - {MISSING, "time_s"} - list_later(name)
    assert {channel.channel for channel in verdict.channels} == common


def test_difference_in_a_common_channel_is_found(tmp_path: Path) -> None:
    record = open_record(rewrite("simulated", tmp_path / "older", missing=MISSING))
    samples = record.samples.copy()
    column = record.header.channel_names.index("torque1_nm")
    samples[40, 1, column] += 1e-9
    header = record.header.model_copy(update={"run_id": "run-2"})
    folder = tmp_path / "run-2"
    write_record(folder, header, record.commands, record.first_tick, samples, record.fault)
    compared = svsa.resimulate(folder)
    different = record.first_tick + 40, f"{header.lanes[1]}.torque1_nm"
    assert (compared.identical, compared.first_difference) == (False, different)


def test_bench_record_without_a_measured_channel_is_not_verified(tmp_path: Path) -> None:
    folder = rewrite("bench", tmp_path / "run-1", missing="deflection_rad")
    with pytest.raises(RecordError, match=r"no deflection_rad"):
        verify_bench_record(open_record(folder))


def test_older_record_is_saved_again_without_the_missing_channel(tmp_path: Path) -> None:
    opened = svsa.open_run(rewrite("simulated", tmp_path / "run-1", missing=MISSING))
    again = svsa.save_run(opened, tmp_path / "again")
    assert MISSING not in open_record(again).header.channel_names
    assert verify(again) == {MISSING, *list_later("simulated")}


@pytest.mark.parametrize("kind", ["csv", "parquet", "mat", "mcap", "html"])
@pytest.mark.parametrize("change", [{"missing": MISSING}, {"added": ADDED}], ids=["older", "newer"])
def test_record_with_other_channels_is_exported(
    kind: str, change: dict[str, Channel | str], tmp_path: Path
) -> None:
    folder = rewrite("comparisons", tmp_path / "run-1", **change)
    svsa.export_run(folder, kind, tmp_path / f"run.{kind}")
    assert (tmp_path / f"run.{kind}").stat().st_size > 1000


@pytest.mark.exhaustive
@pytest.mark.long
def test_lab_plots_measures_and_verifies_an_older_record(tmp_path: Path) -> None:
    name = open_record(RECORDS / "comparisons").header.run_id
    rewrite("comparisons", tmp_path / "runs" / name, missing=MISSING)
    with run_lab_in_process(data=str(tmp_path)) as lab:
        run = f"/api/v1/runs/{name}"
        wait_until(lambda: lab.client.get(run).json().get("state") == "complete")
        answer = lab.client.get(run + "/samples", params={"channels": f"position_rad,{MISSING}"})
        for lane in answer.raise_for_status().json()["lanes"].values():
            assert None not in lane["position_rad"]
            assert set(lane[MISSING]) == {None}
        verified = lab.client.post(run + "/verify").raise_for_status().json()
        assert verified["identical"]
        assert {*verified["not_compared"]} == {MISSING, *list_later("comparisons")}
        assert lab.client.get(run + "/metrics").raise_for_status().json()["lanes"]
        assert lab.client.get(run + "/replay").status_code == 200

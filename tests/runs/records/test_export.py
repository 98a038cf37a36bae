"""Exports open in other programs and contain the same numbers."""

import io
import json
import shutil
import subprocess
from dataclasses import asdict
from datetime import datetime
from pathlib import Path

import numpy as np
import pandas
import pyarrow.parquet as pq
import pytest
import scipy.io
from mcap.reader import make_reader

from svsa.actuators.signals import CHANNEL_INDEX, CHANNELS
from svsa.errors import ParameterError
from svsa.runs.records.export.formats import EXPORT_KINDS, build_file_name, export
from svsa.runs.records.export.mat import build_identifiers
from svsa.runs.records.header import RecordError
from svsa.runs.records.measured_window import find_measured_window, measure
from svsa.runs.records.reader import Record, build_record, open_record
from svsa.runs.records.writer import write_record
from tests.runs.records.records import build_header, build_samples

FIRST_TICK = 40
COMMANDS = [(45, {"kind": "load", "argument": {"kind": "mass", "mass_kg": 3.0}})]
LANES = ("ndobc", "FL 2/x", "end")


@pytest.fixture
def record(tmp_path: Path) -> Record:
    header = build_header(lanes=LANES, name="../a run: Über 'alles' \0 🦾")
    samples = build_samples(300, 3, FIRST_TICK)
    samples[7, 1, CHANNEL_INDEX["torque1_nm"]] = np.nan
    samples[8, 1, CHANNEL_INDEX["torque1_nm"]] = np.inf
    write_record(tmp_path / "run-1", header, COMMANDS, FIRST_TICK, samples)
    return open_record(tmp_path / "run-1")


def test_csv_has_units_in_its_header_and_every_digit(record: Record, tmp_path: Path) -> None:
    export(record, "csv", tmp_path / "run.csv")
    table = pandas.read_csv(tmp_path / "run.csv")
    assert list(table.columns[:2]) == ["tick", "time_s [s]"]
    assert len(table.columns) == 2 + 3 * (len(CHANNELS) - 1)
    assert table["tick"].tolist() == list(range(FIRST_TICK, FIRST_TICK + 300))
    for number, lane in enumerate(LANES):
        read = table[f"{lane}.torque1_nm [N·m]"].to_numpy()
        expected = record.samples[:, number, CHANNEL_INDEX["torque1_nm"]]
        np.testing.assert_array_equal(read, expected)


def test_parquet_is_self_contained(record: Record) -> None:
    stream = io.BytesIO()
    export(record, "parquet", stream)
    table = pq.read_table(io.BytesIO(stream.getvalue()))
    expected = record.samples[:, 2, CHANNEL_INDEX["stiffness_nm_per_rad"]]
    assert table["end.stiffness_nm_per_rad"].to_numpy().tobytes() == expected.tobytes()
    assert json.loads(table.schema.metadata[b"svsa.header"])["run_id"] == "run-1"


def test_mat_opens_in_scipy(record: Record, tmp_path: Path) -> None:
    export(record, "mat", tmp_path / "run.mat")
    read = scipy.io.loadmat(tmp_path / "run.mat", simplify_cells=True)
    assert set(read) >= {"tick", "time_s", "units", "run", "ndobc", "FL_2_x", "end_2"}
    np.testing.assert_array_equal(read["tick"], np.arange(FIRST_TICK, FIRST_TICK + 300))
    for number, lane in enumerate(("ndobc", "FL_2_x", "end_2")):
        for index, channel in enumerate(CHANNELS):
            np.testing.assert_array_equal(
                read[lane][channel.name], record.samples[:, number, index]
            )
    assert read["units"]["stiffness_nm_per_rad"] == "N*m/rad"
    assert json.loads(read["run"]["commands_json"])[0]["tick"] == 45
    assert json.loads(read["run"]["header_json"])["name"] == record.header.name
    assert read["run"]["metrics_json"] == "null", "a lane has samples that are no numbers"
    assert read["run"]["name"].startswith("../a run: ?ber 'alles'")


def test_mat_and_mcap_have_the_metrics_of_the_run() -> None:
    header = build_header(lanes=("one", "two"))
    record = build_record(header, [], FIRST_TICK, build_samples(2000, 2, FIRST_TICK))
    mat, mcap = io.BytesIO(), io.BytesIO()
    export(record, "mat", mat)
    export(record, "mcap", mcap)
    read = scipy.io.loadmat(io.BytesIO(mat.getvalue()), simplify_cells=True)
    (metadata,) = make_reader(io.BytesIO(mcap.getvalue())).iter_metadata()
    window = find_measured_window(record)
    assert window is not None
    expected = [asdict(lane) for lane in measure(record, window) or ()]
    for text in (read["run"]["metrics_json"], metadata.metadata["metrics"]):
        found = json.loads(text)
        assert found["lanes"] == dict(zip(("one", "two"), expected, strict=True))
        assert found["window"]["end_s"] == window.end_s


def test_mat_opens_in_octave(record: Record, tmp_path: Path) -> None:
    octave = shutil.which("octave-cli") or shutil.which("octave")
    if octave is None:
        pytest.skip("GNU Octave is not installed")
    export(record, "mat", tmp_path / "run.mat")
    script = (
        "load('run.mat'); printf('%.17g %d %d %s %.17g\\n', ndobc.position_rad(11), tick(1),"
        " rows(end_2.torque1_nm), units.torque1_nm, run.period_s);"
        " header = jsondecode(run.header_json); assert(header.lanes{2}, 'FL 2/x');"
    )
    done = subprocess.run(
        [octave, "--no-gui", "--norc", "--quiet", "--eval", script],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert done.returncode == 0, done.stderr
    position, tick, rows, unit, period = done.stdout.split()
    assert float(position) == record.samples[10, 0, CHANNEL_INDEX["position_rad"]]
    assert (int(tick), int(rows), unit, float(period)) == (FIRST_TICK, 300, "N*m", 0.001)


def test_mcap_has_joint_states_and_time_series_of_every_lane(record: Record) -> None:
    stream = io.BytesIO()
    export(record, "mcap", stream)
    reader = make_reader(io.BytesIO(stream.getvalue()), validate_crcs=True)
    messages: dict[str, list] = {}
    schemas = {}
    for schema, channel, message in reader.iter_messages():
        assert schema is not None
        assert (schema.encoding, channel.message_encoding) == ("jsonschema", "json")
        schemas[channel.topic] = schema.name
        messages.setdefault(channel.topic, []).append((message, json.loads(message.data)))
    assert schemas == {
        **{f"/{lane}/joint_states": "foxglove.JointStates" for lane in ("ndobc", "FL_2_x", "end")},
        **{f"/{lane}/samples": "svsa.Sample" for lane in ("ndobc", "FL_2_x", "end")},
        "/commands": "svsa.Command",
    }
    assert all(len(found) == 300 for topic, found in messages.items() if topic != "/commands")
    message, state = messages["/end/joint_states"][20]
    began = datetime.fromisoformat(record.header.created).timestamp()
    assert message.log_time == round(began * 1e9) + (FIRST_TICK + 20) * 1_000_000
    stamp = state["timestamp"]
    assert stamp["sec"] * 10**9 + stamp["nsec"] == message.log_time
    assert [joint["name"] for joint in state["joints"]] == ["link", "motor1", "motor2"]
    motor = state["joints"][1]
    row = dict(zip((c.name for c in CHANNELS), record.samples[20, 2], strict=True))
    assert motor["position"] == row["motor1_position_rad"]
    assert motor["effort"] == row["torque1_nm"]
    assert messages["/FL_2_x/samples"][7][1]["torque1_nm"] is None
    assert "effort" not in messages["/FL_2_x/joint_states"][8][1]["joints"][1]
    sample = messages["/end/samples"][20][1]
    assert {name: sample[name] for name in row} == pytest.approx(row, abs=0)
    assert messages["/commands"][0][1] == {"tick": 45, "command": COMMANDS[0][1]}


@pytest.mark.parametrize("kind", EXPORT_KINDS)
def test_empty_run_and_run_in_memory_are_exported(kind: str) -> None:
    for ticks in (0, 5):
        stream = io.BytesIO()
        export(build_record(build_header(), [], 0, build_samples(ticks)), kind, stream)
        assert stream.getvalue()


def test_channels_of_another_version_are_exported() -> None:
    header = build_header(lanes=("a",), channels=({"name": "level_m", "unit": "m", "label": "h"},))
    record = build_record(header, [], 0, np.ones((3, 1, 1)))
    for kind in EXPORT_KINDS:
        export(record, kind, io.BytesIO())


def test_unknown_kind_is_rejected(record: Record) -> None:
    with pytest.raises(ParameterError, match="csv, parquet, mat, mcap"):
        export(record, "xls", io.BytesIO())


def test_failed_export_leaves_no_file(record: Record, tmp_path: Path) -> None:
    with pytest.raises(RecordError, match="cannot be exported"):
        export(record, "csv", tmp_path / "nowhere" / "run.csv")
    content = (tmp_path / "run-1" / "samples.parquet").read_bytes()
    (tmp_path / "run-1" / "samples.parquet").write_bytes(content[:-2000] + content[-1500:])
    with pytest.raises(RecordError):
        export(record, "csv", tmp_path / "run.csv")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["run-1"]


def test_file_names_are_safe(record: Record) -> None:
    assert build_file_name(record, "mat") == "a_run_ber_alles_run-1.mat"
    nameless = build_record(build_header(name="🦾" * 200), [], 0, build_samples(1))
    assert build_file_name(nameless, "csv") == "run-1.csv"


def test_identifiers_are_valid_in_matlab() -> None:
    long = "a" * 70
    found = build_identifiers(["end", "1 b", "ü", "a.b", "a b", long, long + "b", "_"])
    assert found == [
        "end_2", "x1_b", "lane", "a_b", "a_b_2", "a" * 63, "a" * 61 + "_2", "lane_2",
    ]  # fmt: skip

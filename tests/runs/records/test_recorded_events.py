"""Heat events of a bench are in the record of its run, with the text of the live page."""

from dataclasses import asdict
from io import BytesIO
from pathlib import Path

import msgspec
import pytest
from mcap.reader import make_reader
from scipy.io import loadmat

import svsa
from svsa.hardware.session.report import HeatEvents
from svsa.runs.definition.command import build_command
from svsa.runs.definition.paper import get_figure
from svsa.runs.records.export.formats import export
from svsa.runs.records.header import RecordError
from svsa.runs.records.outcome import EVENTS_FILE
from svsa.runs.records.parquet import unpack_parquet
from svsa.runs.records.reader import Record, open_record
from svsa.runs.records.resimulation import read_origin
from svsa.runs.session.simulated import SimulatedSession
from svsa.runs.timeline.events import Event, list_events

from .records import build_header

HEAT = (
    Event(10, 0.01, "heat_limit_began", "Torque of motor 2 limited by heat"),
    Event(30, 0.03, "heat_limit_ended", "Torque of motor 2 no longer limited by heat"),
    Event(50, 0.05, "heat_limit_began", "Torque of motor 1 limited by heat"),
)


@pytest.fixture
def session() -> SimulatedSession:
    return SimulatedSession("test", get_figure("4a").build_configuration(load=False))


@pytest.fixture
def folder(tmp_path: Path, session: SimulatedSession) -> Path:
    """A record that starts after the first event, and ends with the last."""
    heat = HeatEvents()
    written = session.journal.initial.model_dump(mode="json")
    session.step(10)
    heat.log(["motor2"], True, session.journal)
    session.step(10)
    header = build_header("run-1", lanes=("lane1",), configuration=written)
    recorder = svsa.Catalogue(tmp_path).record(header)
    session.start_recording(recorder)
    session.step(10)
    heat.log([], True, session.journal)
    session.change(build_command(30, "law", "fl"))
    session.step(20)
    heat.log(["motor1"], True, session.journal)
    session.stop_recording()
    recorder.close()
    return recorder.folder


def test_replay_shows_the_events_of_the_live_page(folder: Path, session: SimulatedSession) -> None:
    record = open_record(folder)
    assert record.events == HEAT
    live = list(session.journal.events)
    assert [event for event in live if event.kind != "law"] == list(HEAT)
    reported = list_events(*read_origin(record), record.fault, record.events)
    assert sorted(map(str, reported)) == sorted(map(str, live))
    assert [event.tick for event in reported] == [10, 30, 30, 50]


def test_restarted_run_has_no_earlier_events(session: SimulatedSession, tmp_path: Path) -> None:
    HeatEvents().log(["motor2"], True, session.journal)
    session.reset()
    recorder = svsa.Catalogue(tmp_path).record(build_header("run-1", lanes=("lane1",)))
    session.start_recording(recorder)
    session.stop_recording()
    recorder.close()
    assert open_record(recorder.folder).events == ()


def test_exports_contain_the_events(folder: Path) -> None:
    record = open_record(folder)
    parquet, mat, mcap = (write(record, kind) for kind in ("parquet", "mat", "mcap"))
    unpack_parquet(parquet.getvalue(), folder.with_name("run-2"))
    assert open_record(folder.with_name("run-2")).events == HEAT
    described = str(loadmat(mat)["run"]["events_json"])
    assert HEAT[1].label in described
    messages = [message.data for _, channel, message in make_reader(mcap).iter_messages("/events")]
    assert [msgspec.json.decode(data) for data in messages] == [asdict(event) for event in HEAT]


def write(record: Record, kind: str) -> BytesIO:
    stream = BytesIO()
    export(record, kind, stream)
    stream.seek(0)
    return stream


def test_older_record_has_no_events_and_damaged_one_is_reported(folder: Path) -> None:
    (folder / EVENTS_FILE).write_text('[{"tick": 7}]')
    with pytest.raises(RecordError, match=r"events\.json of record run-1 is damaged"):
        open_record(folder)
    (folder / EVENTS_FILE).unlink()
    assert open_record(folder).events == ()

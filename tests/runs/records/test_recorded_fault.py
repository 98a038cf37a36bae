"""A recorded run contains the fault that ended it: in its folder, in the list, in the library."""

from dataclasses import replace
from pathlib import Path

import pytest

import svsa
from svsa.actuators.faults import label_fault
from svsa.errors import Fault
from svsa.runs.definition.paper import get_figure
from svsa.runs.records.catalogue.runs import Catalogue
from svsa.runs.records.header import RecordError
from svsa.runs.records.outcome import FAULT_FILE
from svsa.runs.records.reader import open_record
from svsa.runs.session.simulated import SimulatedSession

from .records import build_header, list_ids

CRASH = svsa.ConstantLoad(torque_nm=(40.0, 0.0, 0.0), start_s=0.1)


def record_crash(catalogue: Catalogue, run_id: str = "run-1") -> Fault:
    """Record a run that a torque far above the spring torques has ended."""
    configuration = get_figure("4a").build_configuration(load=False).changed(loads=(CRASH,))
    session = SimulatedSession("test", configuration)
    written = configuration.model_dump(mode="json")
    header = build_header(run_id, lanes=("lane1",), configuration=written, name="")
    recorder = catalogue.record(header)
    session.start_recording(recorder)
    session.step(5000)
    session.stop_recording()
    catalogue.finish(run_id, recorder.close())
    assert session.fault is not None
    return session.fault


def test_fault_is_the_same_in_folder_list_and_library(
    catalogue: Catalogue, monkeypatch: pytest.MonkeyPatch
) -> None:
    fault = record_crash(catalogue)
    monkeypatch.setenv("SVSA_DATA", str(catalogue.folder))
    assert svsa.open_run("run-1").fault == fault
    assert fault.message in repr(svsa.open_run("run-1"))
    assert catalogue.get("run-1").fault == fault
    assert list_ids(catalogue, search=label_fault(fault.code)) == ["run-1"]


@pytest.mark.parametrize("ends_run", [True, False])
def test_record_has_the_latest_information_on_its_fault(
    catalogue: Catalogue, ends_run: bool
) -> None:
    """Which process stopped the drives is known later than the loss; other reports are excluded."""
    configuration = get_figure("4a").build_configuration(load=False)
    session = SimulatedSession("test", configuration)
    written = configuration.model_dump(mode="json")
    header = build_header("run-1", lanes=("lane1",), configuration=written)
    recorder = catalogue.record(header)
    session.start_recording(recorder)
    session.step(10)
    lost = Fault("loop_lost", 0, 10, 0.01, "The drives are not stopped yet.")
    session.journal.log_fault(lost, ends_run)
    session.journal.refine_fault(replace(lost, message="The supervisor has stopped them."))
    session.journal.refine_fault(replace(lost, code="loop_silent", message="Another."))
    session.stop_recording()
    catalogue.finish("run-1", recorder.close())
    fault = open_record(catalogue.find_folder("run-1")).fault
    assert (fault.message if fault else "") == (ends_run * "The supervisor has stopped them.")


def test_rebuilt_list_contains_the_fault(catalogue: Catalogue) -> None:
    fault = record_crash(catalogue)
    for path in catalogue.folder.glob("catalogue.sqlite*"):
        path.unlink()
    again = Catalogue(catalogue.folder)
    again.recover()
    assert again.get("run-1").fault == fault


def test_record_without_a_fault_is_read(catalogue: Catalogue) -> None:
    record_crash(catalogue)
    (catalogue.find_folder("run-1") / FAULT_FILE).unlink()
    assert open_record(catalogue.find_folder("run-1")).fault is None


def test_damaged_fault_is_reported(catalogue: Catalogue) -> None:
    record_crash(catalogue)
    (catalogue.find_folder("run-1") / FAULT_FILE).write_text('{"code": 7}')
    with pytest.raises(RecordError, match=r"fault\.json of record run-1 is damaged"):
        catalogue.open("run-1")


def test_fault_cleared_before_the_run_is_not_of_the_run(tmp_path: Path) -> None:
    recorder = svsa.Catalogue(tmp_path).record(build_header("run-1"))
    recorder.write_fault(Fault("quick_stop", 0, 0, 0.0, "Stopped."))
    recorder.write_fault(None)
    recorder.close()
    assert open_record(recorder.folder).fault is None


def test_fault_at_rest_is_no_event_of_the_previous_run() -> None:
    """It would be at the run's last tick, and replace the fault that ended the run."""
    session = SimulatedSession("test", get_figure("4a").build_configuration(load=False))
    session.step(10)
    version = session.journal.version
    for number, code in enumerate(("lever_end", "loop_late", "quick_stop")):
        session.journal.log_fault(Fault(code, 0, 10, 0.01, code), ends_run=number == 0)
    faults = [event.label for event in session.journal.events if event.kind == "fault"]
    assert faults == [label_fault("lever_end")]
    assert session.journal.version >= version + 3

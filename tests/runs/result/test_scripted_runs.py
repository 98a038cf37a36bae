"""Runs in a script: changed during the run, recorded and opened again, shown in a notebook."""

import re
import subprocess
import sys
from pathlib import Path
from typing import get_args, get_type_hints

import numpy as np
import pytest

import svsa
from svsa.actuators.signals import CHANNEL_NAMES, CHANNELS
from svsa.runs.definition.command import ApplyLoad, Set, build_command
from svsa.runs.records.reader import open_record
from svsa.runs.records.recorder import Recorder
from svsa.runs.result.channels import ChannelName, Channels
from svsa.runs.session.session import Session
from svsa.runs.session.simulated import SimulatedSession
from tests.runs.records.records import build_header
from tests.runs.session.sessions import build_configuration, read_samples

GAINS = svsa.Gains.from_poles([-50.0] * 4, [-30.0] * 2)
OBSERVER = svsa.ObserverBandwidth(bandwidth_rad_per_s=(50.0, 60.0, 70.0))
CHANGES = (
    svsa.Change(at_s=0.3, position=svsa.ConstantPosition(position_rad=0.1, transition_s=0.1)),
    svsa.Change(at_s=0.1, law="fl", load=svsa.PaperLoad()),
    svsa.Change(
        at_s=0.2,
        gains=GAINS,
        observer=svsa.ObserverBandwidth(bandwidth_rad_per_s=(50.0, 60.0, 70.0)),
    ),
    svsa.Change(at_s=0.35, stiffness=svsa.ConstantStiffness(stiffness_nm_per_rad=55.0)),
    svsa.Change(at_s=0.4, effects=svsa.RIG, law="ndobc"),
)


def play_session() -> Session:
    """A session with the changes of `CHANGES` at the same ticks, applied directly."""
    session = SimulatedSession("test", build_configuration(comparisons=(svsa.Lane(law="fl"),)))
    for change in sorted(CHANGES, key=lambda change: change.at_s):
        session.step(round(change.at_s / 0.001) - session.run.tick)
        for kind, argument in change.list_given().items():
            session.change(build_command(0, kind, argument))
    return session


@pytest.fixture(scope="module")
def result() -> svsa.Result:
    comparisons = (svsa.Lane(law="fl"),)
    return svsa.simulate(
        build_configuration(comparisons=comparisons), duration_s=0.6, commands=CHANGES
    )


def test_changes_during_a_run_equal_those_of_a_session_bit_for_bit(result: svsa.Result) -> None:
    session = play_session()
    session.step(600 - session.run.tick)
    np.testing.assert_array_equal(result.samples, read_samples(session))
    np.testing.assert_array_equal(result.comparisons[0].samples, read_samples(session, 1))
    assert [command.tick for command in result.commands] == [100, 100, 200, 200, 300, 350, 400, 400]


@pytest.mark.parametrize(
    ("commands", "words"),
    [
        ([svsa.Change(at_s=0.7, law="fl")], "at_s is 0.7 s: it must be a number from 0 to 0.6 s"),
        ([{"at_s": 0.1, "law": "fl"}], "a list of svsa.Change"),
    ],
)
def test_impossible_change_is_rejected(commands: list, words: str) -> None:
    with pytest.raises(svsa.ParameterError, match=re.escape(words)):
        svsa.simulate("4b", duration_s=0.6, commands=commands)


def test_empty_change_and_unknown_name_are_rejected() -> None:
    with pytest.raises(
        svsa.ParameterError, match="of law, gains, parameters, observer, spring, position"
    ):
        svsa.Change(at_s=1.0)
    with pytest.raises(svsa.ParameterError, match="controller"):
        svsa.Change(at_s=1.0, controller="fl")  # pyright: ignore[reportCallIssue]


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a run that was recorded from its tick 150 on."""
    folder = tmp_path_factory.mktemp("runs") / "run-1"
    session = SimulatedSession("lab", build_configuration(comparisons=(svsa.Lane(law="fl"),)))
    session.change(Set("law", "fl"))
    session.step(150)
    configuration = session.journal.initial.model_dump(mode="json")
    recorder = Recorder(folder, build_header(configuration=configuration, seed=0, name="Mine"))
    session.start_recording(recorder)
    session.step(100)
    session.change(ApplyLoad(argument=svsa.PaperLoad()))
    session.step(250)
    session.stop_recording()
    recorder.close()
    return folder


def test_recorded_run_opens_as_a_result(recorded: Path) -> None:
    opened = svsa.open_run(recorded)
    np.testing.assert_array_equal(opened.samples, open_record(recorded).samples[:, 0])
    assert (opened.law, opened.name, opened.fault) == ("fl", "Mine", None)
    assert [comparison.law for comparison in opened.comparisons] == ["fl"]
    assert opened.time_s[[0, -1]].tolist() == pytest.approx([0.15, 0.499])
    again = svsa.simulate(
        opened.configuration,
        duration_s=0.5,
        commands=[svsa.Change(at_s=0.0, law="fl"), svsa.Change(at_s=0.25, load=svsa.PaperLoad())],
    )
    np.testing.assert_array_equal(again.samples[150:], opened.samples)
    assert opened.measure(0.2, 0.3) == again.measure(0.2, 0.3), "times are those of the run"
    with pytest.raises(svsa.ParameterError, match=r"from 0\.15 to 0\.5 s"):
        opened.measure(0.0, 0.3)


def test_recorded_run_is_resimulated_and_exported(recorded: Path, tmp_path: Path) -> None:
    assert svsa.resimulate(recorded).identical
    svsa.export_run(recorded, "csv", tmp_path / "run.csv")
    assert (tmp_path / "run.csv").read_text().count("\n") == 1 + 350


def test_run_opens_by_its_id_in_the_catalogue(
    recorded: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SVSA_DATA", str(tmp_path))
    catalogue = svsa.Catalogue()
    (tmp_path / "runs" / "run-1").symlink_to(recorded)
    catalogue.register(open_record(recorded).header)
    assert [run.id for run in svsa.list_runs().runs] == ["run-1"]
    assert len(svsa.open_run("run-1").time_s) == 350
    with pytest.raises(svsa.SvsaError, match="no run 'run-2'"):
        svsa.open_run("run-2")


def test_every_channel_is_known_to_type_checkers_and_completion(result: svsa.Result) -> None:
    assert get_args(ChannelName) == CHANNEL_NAMES
    assert tuple(get_type_hints(Channels))[1:] == CHANNEL_NAMES
    assert set(CHANNEL_NAMES) <= set(dir(result))
    for name in get_args(ChannelName):
        np.testing.assert_array_equal(result[name], getattr(result, name))


def test_misspelled_name_gets_a_suggestion(result: svsa.Result) -> None:
    with pytest.raises(AttributeError, match="perhaps position_rad"):
        _ = result.positon_rad  # pyright: ignore[reportAttributeAccessIssue]
    with pytest.raises(svsa.ParameterError, match="perhaps torque1_nm or torque2_nm"):
        _ = result["torque_nm"]  # pyright: ignore[reportArgumentType]


TYPO = """import svsa
result = svsa.simulate("4a", duration_s=0.1)
right = result.position_rad, result["torque1_nm"]
wrong = result.positon_rad
wrong = result["torque_nm"]
"""


@pytest.mark.exhaustive
def test_misspelled_name_is_a_type_error(tmp_path: Path) -> None:
    (tmp_path / "script.py").write_text(TYPO)
    checker = Path(sys.executable).parent / "basedpyright"
    arguments = [checker, "--level", "error", "--pythonpath", sys.executable, "script.py"]
    found = subprocess.run(arguments, cwd=tmp_path, capture_output=True, text=True, timeout=240)
    lines = re.findall(r"script\.py:(\d+):\d+ - error", found.stdout)
    rules = re.findall(r"\((report\w+)\)", found.stdout)
    assert lines == ["4", "5"], found.stdout
    assert rules == ["reportAttributeAccessIssue", "reportArgumentType"], found.stdout


def test_result_is_shown_as_two_lines_and_a_picture(result: svsa.Result) -> None:
    lines = repr(result).splitlines()
    assert len(lines) == 2
    assert lines[0].startswith(
        "NDOBC → FL → NDOBC compared with FL, 0.6 s at 1000 Hz (600 samples of 34 channels)"
    )
    numbers = r"NDOBC since 0\.4 s: position error [\d.e-]+° rms, .* peak; stiffness .* N·m"
    numbers = r"NDOBC since 0\.4 s: position error [\d.e-]+° rms, .* peak; stiffness .* N·m"
    assert re.fullmatch(numbers, lines[1])
    png = result._repr_png_()
    assert png is not None
    assert png.startswith(b"\x89PNG")
    shown = result._repr_html_()
    assert shown.count("<br>") == 1
    assert "data:image/png;base64," in shown


def test_run_without_samples_reports_it(result: svsa.Result) -> None:
    fault = svsa.errors.Fault("position", 0, 0, 0.0, "q is beyond <its limit>.")
    empty = svsa.Result(result.configuration, np.empty((0, len(CHANNELS))), fault)
    assert repr(empty).splitlines()[1] == "no samples; ended early: q is beyond <its limit>."
    assert empty._repr_png_() is None
    assert "&lt;its limit&gt;" in empty._repr_html_()
    assert "<img" not in empty._repr_html_()


def test_law_names_only_the_samples_that_it_controlled(result: svsa.Result) -> None:
    """Samples keep the name of their law after a change, also in comparisons."""
    stretches = [(law, rows.start, rows.stop) for law, rows in result.list_segments()]
    assert stretches == [("ndobc", 0, 100), ("fl", 100, 400), ("ndobc", 400, 600)]
    comparison = result.comparisons[0]
    assert comparison.list_segments() == [("fl", slice(0, 600))]
    assert all(command.kind != "law" for command in comparison.commands)
    error = result.plot().axes[1]
    drawn = [(line.get_label(), len(line.get_xdata())) for line in error.lines[:3]]
    assert drawn == [("NDOBC", 100), ("FL", 300), ("NDOBC", 200)]
    legend = error.get_legend()
    assert legend is not None
    assert [text.get_text() for text in legend.get_texts()] == ["NDOBC", "FL"]

"""A test against the clock is run anew where the machine stood still meanwhile, and nowhere else.

The machine stands still for the metronome alone, which is stopped.
"""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
CONFTEST = """
import os, signal, time
import pytest
from tests.run_anew import RunAnew

PLUGIN = RunAnew()


def pytest_configure(config):
    config.pluginmanager.register(PLUGIN)
    config.addinivalue_line("markers", "wall_clock")


@pytest.fixture(scope="session")
def stand_still():
    def stall():
        process = PLUGIN.metronome.process.pid
        os.kill(process, signal.SIGSTOP)
        time.sleep(0.3)
        os.kill(process, signal.SIGCONT)
    return stall
"""
TESTS = """
import pytest

made = []
CLOCK = pytest.mark.wall_clock(stall_s=0.2)
NEVER = pytest.mark.wall_clock(stall_s=1e6)


@pytest.fixture(scope="module")
def lab():
    made.append("lab")
    yield made
    made.append("no lab")


@pytest.fixture
def own(lab):
    made.append("own")
    yield
    made.append("not own")


@pytest.fixture(scope="module")
def begun_late(stand_still):
    made.append("late")
    stand_still()
    assert made.count("late") == 2, "the lab does not start"


@CLOCK
def test_fails_once(own, stand_still):
    stand_still()
    assert made.count("own") == 2, "the first time"


@CLOCK
def test_finds_the_lab_as_it_was(lab):
    assert lab == ["lab", "own", "not own", "own", "not own"]


@CLOCK
def test_fails_always(stand_still):
    made.append("always")
    stand_still()
    raise AssertionError("always")


@NEVER
def test_fails_and_nothing_is_late():
    made.append("punctual")
    raise AssertionError("its own fault")


def test_is_not_about_time(stand_still):
    made.append("timeless")
    stand_still()
    raise AssertionError("its own fault")


@CLOCK
def test_is_set_up_late(begun_late):
    pass


def test_each_was_run_as_often_as_it_should():
    names = ("always", "punctual", "timeless", "late")
    assert [made.count(name) for name in names] == [3, 1, 1, 2]
"""


@pytest.fixture(scope="module")
def said(tmp_path_factory: pytest.TempPathFactory) -> str:
    """What pytest says of these tests."""
    folder = tmp_path_factory.mktemp("clock")
    (folder / "conftest.py").write_text(CONFTEST, encoding="utf-8")
    (folder / "test_clock.py").write_text(TESTS, encoding="utf-8")
    (folder / "pytest.ini").write_text("[pytest]\n", encoding="utf-8")
    command = [sys.executable, "-m", "pytest", "-rA", "-p", "no:cacheprovider", "--color=no"]
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "COLUMNS": "300"}
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True)
    return done.stdout + done.stderr


def test_only_what_failed_while_the_machine_stood_still_is_run_anew(said: str) -> None:
    outcomes = {
        line.split()[1].removeprefix("test_clock.py::test_"): line.split()[0]
        for line in said.splitlines()
        if line.startswith(("PASSED ", "FAILED ", "ERROR "))
    }
    assert outcomes == {
        "fails_once": "PASSED",
        "finds_the_lab_as_it_was": "PASSED",
        "fails_always": "FAILED",
        "fails_and_nothing_is_late": "FAILED",
        "is_not_about_time": "FAILED",
        "is_set_up_late": "PASSED",
        "each_was_run_as_often_as_it_should": "PASSED",
    }, said


def test_the_summary_says_what_was_run_anew_and_how_late_the_machine_was(said: str) -> None:
    _, _, reported = said.partition("the machine stood still: run anew")
    lines = [line for line in reported.splitlines() if "where it relies on 0.2 s" in line]
    names = [line.split(":")[2].split()[0].removeprefix("test_") for line in lines]
    assert sorted(names) == ["fails_always", "fails_always", "fails_once", "is_set_up_late"], said
    late = [float(line.partition("late by ")[2].split()[0]) for line in lines]
    assert min(late) > 0.2
    assert "(call: AssertionError: the first time" in reported
    assert "(setup: AssertionError: the lab does not start" in reported

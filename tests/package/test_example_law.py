"""A law of another package: installed, found, run and recorded; without it the record opens."""

import math
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import svsa
from svsa.control.installed import list_law_names
from svsa.runs.definition.command import build_command
from svsa.runs.records.measured_window import trace_record
from svsa.runs.records.reader import open_record
from svsa.runs.records.resimulation import compare_with_simulation
from svsa.runs.timeline.events import list_events
from svsa_server.runs.lanes import list_record_segments, name_lanes

EXAMPLE = Path(__file__).parents[1] / "data" / "example_law"
SCRIPT = """
import sys
from pathlib import Path

import numpy as np

import svsa
from svsa.control.installed import list_law_names
from svsa.runs.records.writer import write_record
from tests.runs.records.records import build_header

slow = svsa.Lane(law="motor_pd", parameters={"frequency_rad_per_s": 20.0})
result = svsa.simulate("4a", "motor_pd", comparisons=(slow,), duration_s=1.0)
print(",".join(list_law_names()))
print(result.metrics.rms_position_error_rad, result.comparisons[0].metrics.rms_position_error_rad)
configuration = result.configuration.model_dump(mode="json")
header = build_header("example", lanes=("PD 60", "PD 20"), configuration=configuration)
samples = [lane.samples for lane in (result, *result.comparisons)]
write_record(Path(sys.argv[1]), header, [], 0, np.stack(samples, axis=1))
assert svsa.resimulate(Path(sys.argv[1])).identical
"""


@pytest.fixture(scope="module")
def installed_run(tmp_path_factory):
    """The output of the script with the package installed, and the record that it wrote."""
    folder = tmp_path_factory.mktemp("example")
    source, target = folder / "source", folder / "installed"
    shutil.copytree(EXAMPLE, source)
    install = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--no-index"]
    install += ["--no-build-isolation", "--disable-pip-version-check", "--target", str(target)]
    subprocess.run([*install, str(source)], check=True, timeout=300, capture_output=True)
    root = Path(svsa.__file__).parents[1]
    environment = os.environ | {"PYTHONPATH": os.pathsep.join([str(target), str(root)])}
    record = folder / "example-run"
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT, str(record)],
        env=environment,
        capture_output=True,
        text=True,
        timeout=600,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.split("\n"), record


@pytest.mark.exhaustive
def test_installed_law_is_found_and_controls(installed_run):
    (names, errors, *_), _ = installed_run
    assert set(names.split(",")) == {*list_law_names(), "motor_pd"}
    fast, slow = map(float, errors.split())
    assert fast != slow, "each lane has its own parameters"
    assert max(map(math.degrees, (fast, slow))) < 2.0


@pytest.mark.exhaustive
def test_record_opens_without_the_package_and_names_the_missing_law(installed_run):
    record = open_record(installed_run[1])
    assert "motor_pd" not in list_law_names()
    result = svsa.open_run(installed_run[1])
    assert result.law == "motor_pd"
    assert result.configuration.law == "motor_pd"
    assert "motor_pd (not installed)" in repr(result)
    assert len(result.samples) == 1000
    assert np.array_equal(result.comparisons[0].samples, record.samples[:, 1])
    parameters = result.configuration.comparisons[0].parameters.model_dump()
    assert parameters == {"frequency_rad_per_s": 20.0, "damping": 1.0}


def test_lanes_and_replay_of_such_a_record_have_its_name(installed_run):
    record = open_record(installed_run[1])
    timeline = trace_record(record)
    assert timeline is not None
    names = name_lanes(list_record_segments(record, timeline))
    assert all(name.startswith("motor_pd (not installed)") for name in names)
    assert len(set(names)) == 2
    configuration = svsa.open_run(installed_run[1]).configuration
    event, *_ = list_events(configuration, [build_command(5, "law", "fl")])
    assert event.label == "motor_pd (not installed) → FL"


def test_resimulation_is_rejected_with_the_installed_laws(installed_run):
    record = open_record(installed_run[1])
    words = "law is 'motor_pd': it must be a law that is installed here: ndobc, fl"
    with pytest.raises(svsa.ParameterError, match=words):
        compare_with_simulation(record)

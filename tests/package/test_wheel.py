"""The wheel: what it is called, what it asks for, and that page and types are in it."""

import subprocess
import sys
import zipfile
from email.parser import Parser
from pathlib import Path

import pytest
from packaging.requirements import Requirement

import svsa
from svsa.inputs.extras import DISTRIBUTION, MODULES

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    folder = tmp_path_factory.mktemp("wheel")
    build = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(folder)]
    done = subprocess.run(build, cwd=ROOT, capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stderr
    (path,) = folder.glob("*.whl")
    with zipfile.ZipFile(path) as archive:
        yield archive


@pytest.fixture
def metadata(wheel):
    (name,) = [name for name in wheel.namelist() if name.endswith(".dist-info/METADATA")]
    return Parser().parsestr(wheel.read(name).decode())


def test_its_name_is_not_that_of_the_other_project_on_the_index(metadata):
    assert metadata["Name"] == DISTRIBUTION == "svsa-lab"
    assert metadata["Version"] == svsa.__version__


def test_types_parameters_page_and_rig_are_in_it(wheel):
    names = set(wheel.namelist())
    assert {
        "svsa/py.typed",
        "svsa/actuators/prototype.toml",
        "svsa/hardware/emulator/bench.toml",
    } <= names
    page = {name.removeprefix("svsa_server/page/") for name in names if "/page/" in name}
    assert {"index.html", "docs.html", "replay.html", "icon.svg"} <= page
    index = wheel.read("svsa_server/page/index.html").decode()
    scripts = [name for name in page if name.startswith("assets/") and name.endswith(".js")]
    assert any(f"/{script}" in index for script in scripts)
    assert not [name for name in names if name.startswith("tests/") or "node_modules" in name]


def test_only_the_library_s_packages_come_without_an_extra(metadata):
    asked = metadata.get_all("Requires-Dist")
    always = {Requirement(line).name for line in asked if "extra ==" not in line}
    assert {"numpy", "scipy", "numba", "pyarrow"} <= always
    assert not always & {"fastapi", "uvicorn", "viser", "python-can", "matplotlib", "nidaqmx"}
    assert set(metadata.get_all("Provides-Extra")) == set(MODULES)
    (can,) = [line for line in asked if line.startswith("python-can")]
    assert "[gs-usb,pcan]" in can
    assert "extra == 'bench'" in can


def test_the_command_says_its_version():
    command = [sys.executable, "-c", "from svsa.cli import main; main()", "--version"]
    said = subprocess.run(command, capture_output=True, text=True, check=True, timeout=120)
    assert said.stdout == f"{svsa.__version__}\n"

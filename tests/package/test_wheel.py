"""The wheel: its name, its requirements, its page and types, and the lab without the guide."""

import os
import subprocess
import sys
import zipfile
from email.parser import Parser
from pathlib import Path

import pytest
import yaml
from packaging.requirements import Requirement

import svsa
from svsa.inputs.extras import DISTRIBUTION, MODULES

ROOT = Path(__file__).parents[2]


SERVE = """
from starlette.testclient import TestClient

import svsa_server
from svsa_server.app import build_app

print(svsa_server.__file__)
with TestClient(build_app(), base_url="http://127.0.0.1") as client:
    print(client.get("/").raise_for_status().headers["content-type"])
    print(client.get("/docs/guide/").raise_for_status().text)
"""


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


@pytest.mark.exhaustive
def test_name_differs_from_the_other_project_on_the_index(metadata):
    assert metadata["Name"] == DISTRIBUTION == "svsa-lab"
    assert metadata["Version"] == svsa.__version__
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    assert citation["version"] == svsa.__version__, "set it to the version of pyproject.toml"


@pytest.mark.exhaustive
def test_types_parameters_page_and_rig_are_included(wheel):
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
    unwanted = ("tests/", "svsa_server/guide/")
    assert not [name for name in names if name.startswith(unwanted) or "node_modules" in name]


def test_build_needs_only_the_packages_of_the_build_system():
    """The documentation, which needs Sphinx and the lab, is no part of an installation."""
    ask = "from hatchling import build; print(build.get_requires_for_build_wheel())"
    done = subprocess.run([sys.executable, "-c", ask], cwd=ROOT, capture_output=True, text=True)
    assert done.stdout == "[]\n", done.stderr


@pytest.mark.exhaustive
def test_installed_server_has_the_page_and_says_how_to_get_the_guide(wheel, tmp_path):
    installed = tmp_path / "installed"
    command = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--no-index"]
    command += ["--disable-pip-version-check", "--target", str(installed), wheel.filename]
    subprocess.run(command, check=True, timeout=300, capture_output=True)
    environment = os.environ | {"PYTHONPATH": str(installed), "SVSA_DATA": str(tmp_path / "data")}
    done = subprocess.run(
        [sys.executable, "-c", SERVE],
        cwd=tmp_path,
        env=environment,
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert done.returncode == 0, done.stderr
    place, kind, page = done.stdout.split("\n", 2)
    assert Path(place).is_relative_to(installed)
    assert kind.startswith("text/html")
    assert "The guide is not installed" in page


@pytest.mark.exhaustive
def test_base_install_requires_only_the_packages_of_the_library(metadata):
    asked = metadata.get_all("Requires-Dist")
    always = {Requirement(line).name for line in asked if "extra ==" not in line}
    assert {"numpy", "scipy", "numba", "pyarrow"} <= always
    assert not always & {"fastapi", "uvicorn", "viser", "python-can", "matplotlib", "nidaqmx"}
    assert set(metadata.get_all("Provides-Extra")) == set(MODULES)
    (can,) = [line for line in asked if line.startswith("python-can")]
    assert "[gs-usb,pcan]" in can
    assert "extra == 'bench'" in can


def test_command_prints_its_version():
    command = [sys.executable, "-c", "from svsa.cli import main; main()", "--version"]
    said = subprocess.run(command, capture_output=True, text=True, check=True, timeout=120)
    assert said.stdout == f"{svsa.__version__}\n"

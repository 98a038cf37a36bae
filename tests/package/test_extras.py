"""The base install is the library: it works without the packages of any extra."""

import json
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from svsa.inputs.extras import MODULES

HIDE = """
import sys
from svsa.inputs.extras import MODULES

hidden = {module for extra in EXTRAS for module in MODULES[extra]}

class WithoutExtras:
    def __init__(self, finder):
        self.finder = finder
        self.find_distributions = getattr(finder, "find_distributions", lambda *_: ())

    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in hidden:
            return None
        return self.finder.find_spec(name, path, target)

assert not hidden & set(sys.modules), "importing the library has imported an extra's package"
sys.meta_path[:] = [WithoutExtras(finder) for finder in sys.meta_path]
"""
ALL = ("server", "client", "bench", "plot", "nidaqmx")
ALL += ("pandas", "xarray", "cluster", "lti", "gym")
CALLS = {
    "svsa.simulate('4a', duration_s=0.01).plot()": "plot",
    "svsa.reproduce(('6a',))": "bench",
    "svsa.connect()": "client",
    "svsa.ActuatorEnv()": "gym",
    "svsa.simulate('4a', duration_s=0.01).to_dataframe()": "pandas",
    "svsa.sweep('4a', {'seed': [1]}, duration_s=0.01)": "pandas",
    "svsa.run_study('perturbation', runs=1)": "pandas",
    "svsa.simulate('4a', duration_s=0.01).to_xarray()": "xarray",
    "run('reproduce')": "plot",
    "run('bench-check', 'bench.toml')": "bench",
    "run('bench-home', 'bench.toml')": "bench",
    "run('bench-dbc', 'bench.toml')": "bench",
    "run('study', 'run', 'gains', '--runs', '1', '--scheduler', 'local')": "cluster",
    "run('serve')": "server",
    "run('openapi')": "server",
}
SAY = """
import contextlib, io, json, svsa, svsa.cli

def run(*arguments):
    sys.argv[1:] = arguments
    svsa.cli.main()

def say(call):
    with contextlib.redirect_stderr(io.StringIO()) as said:
        try:
            exec(call)
        except svsa.MissingExtraError as error:
            return str(error)
        except SystemExit as end:
            assert end.code == 1, (call, said.getvalue())
    return " ".join(said.getvalue().split())

"""


def run_without(extras: tuple[str, ...], program: str) -> str:
    """Return the output of a program in an interpreter without the packages of these extras."""
    code = f"EXTRAS = {extras!r}\n{HIDE}\n{program}"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.exhaustive
def test_library_simulates_without_any_extra():
    program = (
        "import svsa, svsa.cli\n"
        "result = svsa.simulate('4a', 'ndobc', duration_s=0.01)\n"
        "print(len(result.samples), result._repr_png_())\n"
        "assert result._repr_html_().startswith('<p>')"
    )
    assert run_without(ALL, program) == "10 None\n"


@pytest.mark.exhaustive
def test_missing_extra_is_reported_in_one_line_with_its_installation():
    said = json.loads(run_without(ALL, f"{SAY}print(json.dumps([say(c) for c in {[*CALLS]!r}]))"))
    for (call, extra), line in zip(CALLS.items(), said, strict=True):
        line = line.removeprefix("Error: ")
        assert line.startswith("This needs "), call
        assert line.endswith(f"run `pip install 'svsa-lab[{extra}]'`."), call


@pytest.mark.exhaustive
def test_server_needs_no_other_extra_without_a_bench():
    program = (
        "import sys\n"
        "from pathlib import Path\n"
        "from svsa_server.app import build_app\n"
        "from svsa_server.sessions.laboratory import build_shared_session\n"
        "build_app()\n"
        "assert 'viser' not in sys.modules, 'it is loaded when a user looks'\n"
        "try:\n    build_shared_session(Path('svsa/hardware/emulator/bench.toml'))\n"
        "except ImportError as error:\n    print(error)"
    )
    printed = run_without(
        tuple(extra for extra in ALL if extra not in ("server", "client")), program
    )
    assert "pip install 'svsa-lab[bench]'" in printed


def test_each_extra_is_locked() -> None:
    """The locked packages are those that `make run`, the tests and CI install."""
    root = Path(__file__).parents[2]
    extras = tomllib.loads((root / "pyproject.toml").read_text())["project"][
        "optional-dependencies"
    ]
    locked = set(re.findall(r"^[\w-]+", (root / "requirements.lock").read_text(), re.MULTILINE))
    names = {extra: {re.split(r"[\[>=<;]", each)[0] for each in extras[extra]} for extra in extras}
    assert {*extras} == {*MODULES} == {*ALL}
    assert set().union(*names.values()) <= locked
    assert {"gs-usb", "uptime"} <= locked, "of python-can's adapters"

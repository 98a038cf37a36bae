"""Dependencies of the code cache: each file depends on its text and on its imports."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

import svsa
from svsa.numerics.compilation import find_sources

LIBRARY = Path(svsa.__file__).parent

PACKAGE = {
    "__init__.py": "",
    "law.py": "from svsa.actuators.signals import Torque\nfrom .gain import compute_gain\n",
    "gain.py": "from svsa.numerics.compilation import compiled\n\n"
    "@compiled\ndef compute_gain(x):\n    return x\n",
}
CALLER = """
from svsa.numerics.compilation import compiled, is_compiled_before
from plugged.gain import compute_gain

@compiled
def double(x):
    return 2.0 * compute_gain(x)

print(is_compiled_before(compute_gain), double(1.5))
"""


def find_names(file: str) -> set[str]:
    sources = find_sources(LIBRARY / file)
    return {path.relative_to(LIBRARY).as_posix() for path in sources}


def test_file_depends_on_all_its_imports() -> None:
    names = find_names("control/laws/ndobc.py")
    assert {"control/laws/ndobc.py", "control/laws/feedback_linearization.py"} <= names
    assert {"actuators/linearization.py", "actuators/spring.py", "numerics/packed.py"} <= names


def test_loop_does_not_depend_on_laws() -> None:
    """A new or changed law recompiles neither the loop nor another law."""
    laws = {"control/laws/feedback_linearization.py", "control/laws/ndobc.py"}
    assert not laws & find_names("simulation/loop/loop.py")
    assert not laws & find_names("simulation/loop/measured.py")
    assert "control/laws/ndobc.py" not in find_names("control/laws/feedback_linearization.py")


def test_files_without_equations_recompile_nothing() -> None:
    named = {
        "cli.py",
        "runs/session/journal.py",
        "runs/execution/run.py",
        "runs/metrics/metrics.py",
        "runs/definition/command.py",
    }
    assert all((LIBRARY / name).exists() for name in named)
    assert not named & find_names("simulation/loop/loop.py")


@pytest.fixture
def package(tmp_path: Path) -> Path:
    folder = tmp_path / "plugged"
    folder.mkdir()
    for name, text in PACKAGE.items():
        (folder / name).write_text(text)
    return folder


def test_package_depends_on_all_its_files(package: Path) -> None:
    sources = find_sources(package / "law.py")
    assert {package / name for name in PACKAGE} <= set(sources)
    assert LIBRARY / "actuators" / "signals.py" in sources


@pytest.mark.exhaustive
@pytest.mark.long
def test_function_of_a_package_is_cached_until_the_package_changes(
    package: Path,
) -> None:
    (package / "caller.py").write_text(CALLER)
    paths = os.pathsep.join([str(package.parent), str(LIBRARY.parent)])
    environment = os.environ | {"PYTHONPATH": paths, "SVSA_CACHE": str(package.parent / "cache")}

    def call() -> str:
        return subprocess.run(
            [sys.executable, "-m", "plugged.caller"],
            env=environment,
            capture_output=True,
            text=True,
            check=True,
            timeout=300,
        ).stdout.strip()

    assert call() == "False 3.0"
    assert call() == "True 3.0"
    changed = PACKAGE["gain.py"].replace("return x", "return 5.0 * x")
    (package / "gain.py").write_text(changed)
    assert call() == "False 15.0", "what was compiled of another file before is not used"


START = """
import sys
from importlib.metadata import entry_points
import numpy as np
import svsa
from svsa.numerics.compilation import compiled

svsa.simulate("4a", "ndobc", duration_s=0.01)
late = ("scipy.linalg", "sqlite3", "svsa.analysis.design")
print([name for name in late if name in sys.modules])

for command in entry_points(group="svsa.commands"):
    command.load()
import svsa_server.app
late = ("scipy.special", "scipy.stats", "scipy.signal", "pyarrow")
print([name for name in late if name in sys.modules])

@compiled
def multiply(a, b):
    return a @ b

print(multiply(np.diag([2.0, 3.0]), np.array([5.0, 7.0])).tolist())
print(len([*svsa.design.linearize(15.0)]), svsa.list_runs.__name__, svsa.Catalogue.__name__)
"""


@pytest.mark.exhaustive
@pytest.mark.long
def test_start_imports_the_modules_of_a_run_and_others_on_demand() -> None:
    """Also without numba's own check for scipy; matrices in the function of a law still work."""
    answer = subprocess.run(
        [sys.executable, "-c", START], capture_output=True, text=True, check=True, timeout=300
    )
    assert answer.stdout.splitlines() == ["[]", "[]", "[10.0, 21.0]", "4 list_runs Catalogue"]


def test_unknown_name_of_the_library_raises_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match="'svsa' has no attribute 'nothing'"):
        _ = svsa.nothing  # pyright: ignore[reportAttributeAccessIssue]

"""Fixtures that more than one folder of tests uses."""

import gc
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings
from xdist.remote import Producer

from svsa.numerics.compilation import watch_compilation
from tests.lab import Lab, run_lab
from tests.run_anew import RunAnew
from tests.side_by_side import SideBySide

SEARCHED = settings(deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow])
"""Of what hypothesis draws: the same cases each time, however slow the machine."""
settings.register_profile("every", SEARCHED)
settings.register_profile("shown", SEARCHED, max_examples=25)

TESTS = Path(__file__).parent
COMPILED = "compiled"
ORDER = (
    *("package", "", "inputs", "numerics", "actuators", "control", "simulation", "runs"),
    *("analysis", "evaluation", "teaching", "hardware", "scene", "server", "client", "browser"),
)
"""Of the folders; what stands in none is \"\"."""

gc.disable()
"""Until all tests are read: what is read stays, and is looked through again and again otherwise."""


@pytest.hookimpl(hookwrapper=True)
def pytest_collection() -> Iterator[None]:
    yield
    gc.freeze()
    gc.enable()


def pytest_configure(config: pytest.Config) -> None:
    config.pluginmanager.register(RunAnew())


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Quick tests first; the browser last, since its driver keeps an event loop running."""
    items.sort(key=rank)


def rank(item: pytest.Item) -> int:
    folders = item.path.relative_to(TESTS).parts[:-1]
    return ORDER.index(folders[0] if folders else "")


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Producer) -> SideBySide | None:
    return SideBySide(config, log) if config.getvalue("dist") == "loadfile" else None


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_setup(item: pytest.Item) -> Iterator[None]:
    yield from note_compilation(item)


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_call(item: pytest.Item) -> Iterator[None]:
    yield from note_compilation(item)


def note_compilation(item: pytest.Item) -> Iterator[None]:
    names: list[str] = []
    with watch_compilation(names.append):
        yield
    if names:
        words = f"{', '.join(names[:3])}{' …' if len(names) > 3 else ''} ({len(names)})"
        item.user_properties.append((COMPILED, words))


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Tell what `tests.compile_all` has not compiled before."""
    reported = [
        f"{report.nodeid}: {dict(report.user_properties)[COMPILED]}"
        for reports in terminalreporter.stats.values()
        for report in reports
        if isinstance(report, pytest.TestReport)
        and report.when == "call"
        and COMPILED in dict(report.user_properties)
    ]
    if reported:
        terminalreporter.section("compiled inside a test")
    for line in reported:
        terminalreporter.write_line(line)


@pytest.fixture(scope="session")
def shared_lab() -> Iterator[Lab]:
    with run_lab() as lab:
        yield lab


@pytest.fixture
def lab(shared_lab: Lab) -> Iterator[Lab]:
    """The shared lab, begun anew; it stands still after the test."""
    shared_lab.restart()
    yield shared_lab
    shared_lab.client.post(shared_lab.session + "/pause")

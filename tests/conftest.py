"""Fixtures that several test folders share."""

import gc
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

from svsa.numerics.compilation import watch_compilation
from tests.lab import Lab, run_lab

SEARCHED = settings(deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow])
"""Settings of hypothesis: the same cases in each run, and no deadline on a slow machine."""
settings.register_profile("every", SEARCHED)
settings.register_profile("shown", SEARCHED, max_examples=25)

TESTS = Path(__file__).parent
COMPILED = "compiled"
ORDER = (
    *("package", "inputs", "numerics", "actuators", "control", "simulation", "runs"),
    *(
        "analysis",
        "evaluation",
        "teaching",
        "hardware",
        "scene",
        "server",
        "client",
        "docs",
        "browser",
    ),
)
"""The folders, fast tests first. The browser tests are last: the synchronous driver of Playwright
leaves an event loop running in its process, in which `asyncio.run` raises an error. xdist assigns
modules in this order, so no process receives another module after its first browser module.
"""
RERUNS = 2
"""A shared machine may suspend a process for longer than a test against the clock tolerates."""

gc.disable()
"""Off during collection: the collected objects stay alive, so scanning them only costs time."""


@pytest.hookimpl(hookwrapper=True)
def pytest_collection() -> Iterator[None]:
    yield
    gc.freeze()
    gc.enable()


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Sort the tests by folder, and rerun those that are marked `wall_clock` if they fail."""
    items.sort(key=lambda item: ORDER.index(item.path.relative_to(TESTS).parts[0]))
    for item in items:
        if item.get_closest_marker("wall_clock"):
            item.add_marker(pytest.mark.flaky(reruns=RERUNS))


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
    """Report functions that were compiled during a test because `tests.compile_all` omits them."""
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
    """The shared lab, restarted; it is paused after the test."""
    shared_lab.restart()
    yield shared_lab
    shared_lab.client.post(shared_lab.session + "/pause")

"""A test against the clock is fair only while the machine keeps time: what is done where not.

A test that failed while the machine stood still for longer than it relies on is run anew, at most
twice, and the summary says so. One that failed while nothing was late has failed. A test says what
it relies on: `wall_clock(stall_s=…)`.
"""

import time

import pytest
from _pytest.runner import call_and_report

from tests.metronome import Metronome

ATTEMPTS = 3
STALL_S = 0.1
"""What a test relies on that does not say so, s."""
TOLD = "run anew"


class RunAnew:
    """A plugin. metronome: from the first such test on."""

    def __init__(self) -> None:
        self.metronome: Metronome | None = None

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtest_protocol(self, item: pytest.Item, nextitem: pytest.Item | None) -> object:
        mark = item.get_closest_marker("wall_clock")
        if mark is None:
            return None
        if self.metronome is None:
            self.metronome = Metronome()
        longest_s = mark.kwargs.get("stall_s", STALL_S)
        item.ihook.pytest_runtest_logstart(nodeid=item.nodeid, location=item.location)
        for left in reversed(range(ATTEMPTS)):
            begin = time.monotonic()
            reports = [call_and_report(item, "setup", log=False)]
            if reports[0].passed and not item.config.getoption("setuponly"):
                reports.append(call_and_report(item, "call", log=False))
            stall_s = self.metronome.find_longest(begin) if reports[-1].failed and left else 0.0
            again = stall_s > longest_s
            following = find_kept(item, reports[0]) if again else nextitem
            reports.append(call_and_report(item, "teardown", log=False, nextitem=following))
            item._request, item.funcargs = False, None  # pyright: ignore[reportAttributeAccessIssue]
            if not again:
                break
            failed = next(report for report in reports if report.failed)
            item.user_properties.append((TOLD, describe(failed, stall_s, longest_s)))
            item._initrequest()  # pyright: ignore[reportAttributeAccessIssue]
        for report in reports:
            item.ihook.pytest_runtest_logreport(report=report)
        item.ihook.pytest_runtest_logfinish(nodeid=item.nodeid, location=item.location)
        return True

    def pytest_terminal_summary(self, terminalreporter: pytest.TerminalReporter) -> None:
        reported = [
            f"{report.nodeid}: {words}"
            for reports in terminalreporter.stats.values()
            for report in reports
            if isinstance(report, pytest.TestReport) and report.when == "teardown"
            for name, words in report.user_properties
            if name == TOLD
        ]
        if reported:
            terminalreporter.section("the machine stood still: run anew")
        for line in reported:
            terminalreporter.write_line(line)

    def pytest_unconfigure(self) -> None:
        if self.metronome is not None:
            self.metronome.close()


def find_kept(item: pytest.Item, setup: pytest.TestReport) -> pytest.Item:
    """What is not torn down before the test begins anew: its module, and that not where it was
    not set up, since a fixture that failed would fail again.
    """
    module = item.getparent(pytest.Module)
    assert module is not None and module.parent is not None
    return module if setup.passed else module.parent  # pyright: ignore[reportReturnType]


def describe(failed: pytest.TestReport, stall_s: float, longest_s: float) -> str:
    """Why it is run anew, and what it had failed with."""
    lines = failed.longreprtext.splitlines()
    what = next((line[1:].strip() for line in lines if line.startswith("E ")), "")
    return f"late by {stall_s:.2f} s, where it relies on {longest_s:g} s ({failed.when}: {what})"

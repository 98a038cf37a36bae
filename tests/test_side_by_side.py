"""The modules go to processes by kind, the longest first, and none is left out."""

from types import SimpleNamespace

import pytest

from tests.side_by_side import OTHERS_EACH, WORTH, SideBySide

PAGES = [
    "tests/browser/test_ranking.py",
    "tests/browser/test_life.py",
    "tests/browser/test_view.py",
]
OTHERS = [
    "tests/actuators/test_spring.py",
    "tests/evaluation/studies/test_cluster.py",
    "tests/runs/test_batch.py",
]


class Process:
    """What a scheduler knows of one: its number, what it was sent, whether it has to end."""

    def __init__(self, number: int) -> None:
        self.gateway = SimpleNamespace(id=f"gw{number}")
        self.sent: list[int] = []
        self.shutting_down = False

    def send_runtest_some(self, indices: list[int]) -> None:
        self.sent += indices

    def shutdown(self) -> None:
        self.shutting_down = True


def share(units: list[str], processes: int, lazy: int | None = None) -> list[list[str]]:
    """The modules that each process does, one after the other; the lazy one does nothing."""
    tests = [f"{unit}::test_{number}" for unit in units for number in range(3)]
    nodes = [Process(number) for number in range(processes)]
    config = SimpleNamespace(
        getvalue=lambda name: ["popen"] * processes, option=SimpleNamespace(loadscopereorder=False)
    )
    scheduler = SideBySide(config)
    for node in nodes:
        scheduler.add_node(node)
        scheduler.add_node_collection(node, tests)
    scheduler.schedule()
    done = [0] * processes
    while any(done[i] < len(node.sent) for i, node in enumerate(nodes) if i != lazy):
        for i, node in enumerate(nodes):
            if i != lazy and done[i] < len(node.sent):
                scheduler.mark_test_complete(node, node.sent[done[i]])
                done[i] += 1
    return [list(dict.fromkeys(tests[i].split("::")[0] for i in node.sent)) for node in nodes]


@pytest.mark.parametrize("processes", [1, 2, 3, 4])
def test_every_module_is_done_once_and_none_after_a_browser_but_a_browser(processes: int) -> None:
    shared = share(PAGES + OTHERS, processes)
    assert sorted([unit for units in shared for unit in units]) == sorted(PAGES + OTHERS)
    for units in shared:
        browser = [unit in PAGES for unit in units]
        assert browser == sorted(browser), units


def test_one_half_begins_with_browsers_and_each_with_its_longest() -> None:
    computing, showing = share(PAGES + OTHERS, 2)
    assert (computing[0], showing[0]) == ("tests/evaluation/studies/test_cluster.py", PAGES[1])
    assert showing == [PAGES[1], PAGES[2], PAGES[0]]


def test_who_is_done_with_the_others_helps_with_the_browsers() -> None:
    computing, showing = share(PAGES + OTHERS, 2, lazy=1)
    assert computing[:3] == [OTHERS[1], OTHERS[0], OTHERS[2]]
    assert set(computing[3:]) == set(PAGES) - set(showing)


@pytest.mark.parametrize(("pages", "begin"), [(WORTH, 1), (WORTH + 1, 2), (3 * WORTH, 2)])
def test_more_begin_with_browsers_where_there_are_many(pages: int, begin: int) -> None:
    browsers = [f"tests/browser/test_{number}.py" for number in range(pages)]
    shared = share(browsers + OTHERS, 4)
    assert sum(units[0] in browsers for units in shared) == begin


def test_browsers_begin_when_the_others_left_take_as_long() -> None:
    others = [f"tests/model/test_{number}.py" for number in range(4 * OTHERS_EACH)]
    computing, showing = share(PAGES + others, 2)
    assert showing[0] in others
    assert set(showing[-len(PAGES) :]) == set(PAGES)
    assert not set(computing) & set(PAGES)

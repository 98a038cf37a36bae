"""Fixtures that more than one folder of tests uses."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.lab import Lab, run_lab

TESTS = Path(__file__).parent
ORDER = ("package", "equations", "experiment", "contract", "hardware", "service", "browser")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Quick tests first; the browser last, since its driver keeps an event loop running."""
    items.sort(key=lambda item: ORDER.index(item.path.relative_to(TESTS).parts[0]))


@pytest.fixture(scope="session")
def shared_lab() -> Iterator[Lab]:
    with run_lab() as lab:
        yield lab


@pytest.fixture
def lab(shared_lab: Lab) -> Lab:
    """The shared lab, begun anew on Figure 4A: one lane, no load, no recording."""
    shared_lab.client.delete(shared_lab.session + "/recording")
    shared_lab.client.put(shared_lab.session + "/lanes", json={"rivals": []}).raise_for_status()
    shared_lab.load_figure()
    return shared_lab

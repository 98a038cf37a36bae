"""Fixtures that more than one folder of tests uses."""

from collections.abc import Iterator

import pytest

from tests.lab import Lab, run_lab


@pytest.fixture(scope="session")
def shared_lab() -> Iterator[Lab]:
    with run_lab() as lab:
        yield lab


@pytest.fixture
def lab(shared_lab: Lab) -> Lab:
    """The shared lab, begun anew on Figure 4A without its load."""
    shared_lab.load_figure()
    return shared_lab

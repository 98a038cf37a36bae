"""The lab of these tests runs in their process, since they use REST only."""

from collections.abc import Iterator

import pytest

from tests.lab import Lab
from tests.lab_in_process import run_lab_in_process


@pytest.fixture(scope="session")
def shared_lab() -> Iterator[Lab]:
    with run_lab_in_process() as lab:
        yield lab

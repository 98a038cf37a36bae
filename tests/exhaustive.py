"""Parameters of which `make test` runs some cases and `make test-all` runs all."""

from collections.abc import Collection, Iterable

import pytest
from _pytest.mark.structures import ParameterSet


def exhaust(cases: Iterable[object], shown: Collection[object]) -> list[ParameterSet]:
    """Return every case as a parameter; cases that are not `shown` are marked `exhaustive`."""
    cases = list(cases)
    assert all(case in cases for case in shown), shown
    return [
        pytest.param(case, marks=() if case in shown else pytest.mark.exhaustive) for case in cases
    ]

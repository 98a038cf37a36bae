"""What `make test` shows of some cases, and `make test-all` of every one."""

from collections.abc import Collection, Iterable

import pytest
from _pytest.mark.structures import ParameterSet


def exhaust(cases: Iterable[object], shown: Collection[object]) -> list[ParameterSet]:
    """Every case as a parameter; those that are not `shown` in `make test-all` alone."""
    cases = list(cases)
    assert all(case in cases for case in shown), shown
    return [
        pytest.param(case, marks=() if case in shown else pytest.mark.exhaustive) for case in cases
    ]

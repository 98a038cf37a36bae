"""A command that the loop of a bench rejects: the server gets the reason, the loop continues."""

from collections.abc import Iterator

import pytest

from svsa.errors import ParameterError
from svsa.hardware.realtime.launch import _check
from svsa.hardware.realtime.memory import LoopMemory
from tests.hardware.realtime.first_uses import Rehearsal
from tests.hardware.wired_bench import WiredBench

REFUSED = [
    ("comparisons", [{"law": "fl"}] * 4, "comparisons"),
    ("lane", {"lane": 4, "setting": {"law": "fl"}}, "lane"),
    ("position", {"kind": "constant", "position_rad": 1e9}, "position_rad"),
    ("law", "no_law", "law"),
]


@pytest.fixture(scope="module")
def rehearsal() -> Iterator[Rehearsal]:
    memory = LoopMemory.create()
    with WiredBench() as wired:
        yield Rehearsal(wired, memory)
    memory.close()


@pytest.mark.parametrize(("kind", "argument", "name"), REFUSED)
def test_rejected_value_reaches_the_server(
    rehearsal: Rehearsal, kind: str, argument: object, name: str
) -> None:
    """For any value: four lanes are objects, which JSON cannot represent directly."""
    before = rehearsal.loop.run.configuration
    answer = rehearsal.ask("change", {"tick": 0, "kind": kind, "argument": argument})
    with pytest.raises(ParameterError) as raised:
        _check(answer)
    (violation,) = raised.value.violations
    assert name in violation.name
    assert violation.bound in answer["refused"]
    assert rehearsal.loop.run.configuration == before

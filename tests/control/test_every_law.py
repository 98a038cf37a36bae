"""Every law that is installed: live, recorded, simulated again, in a batch — always the same bits.

On the emulator: `tests.hardware.test_closed_loop`.
"""

from pathlib import Path

import numpy as np
import pytest

import svsa
from svsa.actuators.faults import FAULT_CODES
from svsa.actuators.signals import CHANNEL_INDEX, State
from svsa.control.installed import list_law_names
from svsa.runs.definition.command import ApplyLoad
from svsa.runs.execution.batch import run_configurations
from svsa.runs.records.recorder import Recorder
from svsa.runs.session.simulated import SimulatedSession
from tests.exhaustive import exhaust
from tests.runs.records.records import build_header
from tests.runs.session.sessions import (
    PULSE,
    SHOWN_IN_BATCHES,
    build_configuration,
    read_samples,
)

TICKS = 200
CHANGED_AT = 68
LATER = svsa.ConstantLoad(torque_nm=(0.2, 0.1, 0.0))
U1 = CHANNEL_INDEX["torque1_nm"]


@pytest.mark.parametrize("law", list_law_names())
def test_recorded_session_is_resimulated_bit_for_bit(law: str, tmp_path: Path) -> None:
    """With the effects of the rig, irregular wake-ups and a command between two of them.

    A law that ends its run ends it at the same tick in both.
    """
    session = SimulatedSession("lab", build_configuration(PULSE, law=law, effects=svsa.RIG))
    initial = session.journal.initial.model_dump(mode="json")
    header = build_header(lanes=(law,), configuration=initial, seed=0)
    recorder = Recorder(tmp_path / "run-1", header)
    session.start_recording(recorder)
    for ticks in (1, 7, CHANGED_AT - 8):
        session._advance(ticks)
    session.change(ApplyLoad(argument=LATER))
    for ticks in (100, TICKS - CHANGED_AT - 100):
        session._advance(ticks)
    session.stop_recording()
    recorder.close()
    found = svsa.resimulate(tmp_path / "run-1")
    assert (found.identical, found.first_difference) == (True, None)
    assert found.ticks == session.run.tick > CHANGED_AT
    opened = svsa.open_run(tmp_path / "run-1")
    np.testing.assert_array_equal(opened.samples, read_samples(session, 0))
    assert np.any(opened.samples[:, U1] != 0.0)


@pytest.mark.long
@pytest.mark.parametrize("law", exhaust(list_law_names(), SHOWN_IN_BATCHES))
def test_law_in_a_batch_ends_as_in_a_live_session(law: str) -> None:
    """In a batch with a run of another plant stiffness, which differs."""
    first = build_configuration(PULSE, law=law, effects=svsa.RIG)
    softer = first.actuator.changed(link_inertia_kg_m2=0.9 * first.actuator.link_inertia_kg_m2)
    both = [first, first.changed(actuator=softer)]
    found = run_configurations(both, TICKS * first.sampling.period_s)
    for one, configuration in zip(found, both, strict=True):
        session = SimulatedSession("live", configuration)
        session._advance(TICKS)
        assert one["ticks"] == session.run.tick
        fault = session.run.fault
        assert FAULT_CODES.get(one["code"]) == (fault.code if fault else None)
        assert tuple(one[name] for name in State._fields) == session.run.lanes[0].x
    assert found["q"][0] != found["q"][1]

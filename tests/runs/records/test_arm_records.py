"""A recorded arm: the same samples when it is opened, and bit-identical when simulated again."""

import json

import pytest

import svsa
from svsa.runs.records.header import HEADER_FILE, RecordError

OPTIONS = {"duration_s": 0.5, "feedforward": True}


def simulate():
    loads = [
        svsa.TipMass(mass_kg=0.1, start_s=0.1),
        svsa.TipImpulse(impulse_ns=(0.05, 0.0), start_s=0.3),
        svsa.Wall(normal_rad=3.14159, distance_m=-0.3, stiffness_n_per_m=2000.0),
    ]
    push = svsa.PulseLoad(torque_nm=(0.3, 0.0, 0.0), start_s=0.2, duration_s=0.1)
    joint1 = {"law": "fl", "effects": svsa.RIG}
    return svsa.simulate_arm(**OPTIONS, tip_loads=loads, joint1=joint1, joint2={"loads": push})


def test_record_is_read_unchanged_and_resimulated_bit_for_bit(tmp_path):
    result = simulate()
    folder = svsa.save_run(result, tmp_path / "arm", name="Push")
    opened = svsa.open_arm_run(folder)
    assert opened.configuration == result.configuration
    assert opened.samples.tobytes() == result.samples.tobytes()
    again = svsa.resimulate(folder)
    assert again.identical and again.ticks == 500


def test_another_setting_is_another_run(tmp_path):
    folder = svsa.save_run(simulate(), tmp_path / "arm")
    header = json.loads((folder / HEADER_FILE).read_text())
    header["configuration"]["arm"]["links"]["chain"][1]["mass_kg"] *= 1.0 + 1e-9
    (folder / HEADER_FILE).write_text(json.dumps(header))
    again = svsa.resimulate(folder)
    assert not again.identical
    assert again.first_difference is not None and again.first_difference[0] <= 2


def test_fault_is_recorded(tmp_path):
    push = svsa.ConstantLoad(torque_nm=(20.0, 0.0, 0.0), start_s=0.1)
    result = svsa.simulate_arm(**OPTIONS, joint2={"loads": push})
    opened = svsa.open_arm_run(svsa.save_run(result, tmp_path / "arm"))
    assert result.fault is not None and opened.fault == result.fault
    assert svsa.resimulate(tmp_path / "arm").identical


def test_run_of_the_other_kind_is_rejected_with_the_function_to_call(tmp_path):
    arm = svsa.save_run(simulate(), tmp_path / "arm")
    joint = svsa.save_run(svsa.simulate("4a", duration_s=0.1), tmp_path / "joint")
    with pytest.raises(RecordError, match=r"svsa\.open_arm_run"):
        svsa.open_run(arm)
    with pytest.raises(RecordError, match=r"svsa\.open_run"):
        svsa.open_arm_run(joint)

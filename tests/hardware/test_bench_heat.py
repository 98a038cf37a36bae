"""A load that a motor does not bear for long, on the emulator in lockstep, from cold.

The 3 kg of the paper cause 2 N·m on motor 2, whose continuous torque is 1.22 N·m.
"""

import socket
from typing import Any, NamedTuple

import pytest

from svsa.errors import Fault
from svsa.hardware.description.file import read_bench
from svsa.hardware.emulator.experiment import EMULATOR_BENCH
from svsa.hardware.realtime.configuration import build_bench_configuration
from svsa.hardware.realtime.link import Link
from svsa.hardware.realtime.memory import LoopMemory
from svsa.hardware.realtime.prepared_laws import PreparedLaws
from svsa.hardware.realtime.process import LoopProcess
from svsa.hardware.safety.endurance import Endurance, find_endurance
from svsa.hardware.safety.heartbeat import Heartbeats
from svsa.hardware.safety.machine import BenchStatus
from svsa.simulation.plant.loads import Load
from svsa.simulation.plant.loads.constant import ConstantLoad
from svsa.simulation.plant.loads.mass import MassLoad
from svsa.simulation.plant.loads.paper import PaperLoad
from svsa.simulation.plant.loads.pulse import PulseLoad
from tests.hardware.emulator.in_process_emulator import start_in_process

from .watched_bench import FIGURE, Bench, make_ready

LEFT_HEAT = [0.001, 0.002]
"""The remaining heat of an earlier loop: practically cold."""
BEFORE_TICKS, LONGEST_TICKS = 2000, 10_000
LASTING_NM = 1.16 * 50.0 * 0.9 * 0.0234


class Reported(NamedTuple):
    """Shared values and messages of the loop's process during the load."""

    seconds: float
    allowed_nm: float
    messages: list[dict[str, Any]]
    fault: Fault


@pytest.fixture(scope="module")
def reported() -> Reported:
    with start_in_process() as emulator:
        bench = make_ready(emulator)
        memory, beats = LoopMemory.create(), Heartbeats.create()
        memory.fields["heat"] = LEFT_HEAT
        ours, theirs = socket.socketpair()
        link = Link(theirs)
        try:
            process = LoopProcess(
                bench.loop,
                bench.plant,
                bench._clock,
                1.0,
                Link(ours),
                memory,
                beats,
                PreparedLaws(),
            )
            assert [motor.winding.heat for motor in bench.plant.motors] == LEFT_HEAT
            return hang_paper_load(bench, process, memory, link)
        finally:
            ours.close()
            link.close()
            memory.close()
            beats.close()
            bench.close()


def hang_paper_load(bench: Bench, process: LoopProcess, memory: LoopMemory, link: Link) -> Reported:
    bench.start()
    bench.tick(BEFORE_TICKS)
    bench.emulator.control.load(PaperLoad())
    begin, held, messages = bench.now(), None, []
    for _ in range(LONGEST_TICKS):
        bench.tick()
        process._note(0.0, 0.0, 0)
        process._report_state()
        messages += link.receive()
        if held is None and memory.fields["is_limited_by_heat"][1]:
            held = bench.now() - begin
        if bench.plant.fault is not None:
            assert held is not None
            allowed = float(memory.fields["allowed_nm"][1])
            return Reported(held, allowed, messages, bench.plant.fault)
    raise AssertionError("the motor bore it")


def test_fault_due_to_heat_names_the_heat_first(reported: Reported) -> None:
    assert reported.fault.code == "lever_end"
    assert reported.fault.message.startswith("The torque of motor 2 was limited by heat")
    assert "End of stiffness range" in reported.fault.message
    assert reported.fault.values["motor2_heat"] > 0.9
    assert LASTING_NM <= reported.allowed_nm < 2.0


def test_loop_reports_the_limited_motor_before_the_fault(reported: Reported) -> None:
    said = [(message["status"], message["limited_by_heat"]) for message in reported.messages]
    assert said[0] == (BenchStatus.RUN, [])
    assert (BenchStatus.RUN, ["motor2"]) in said
    assert said[-1] == (BenchStatus.FAULT, ["motor2"])


def test_fault_is_predicted_from_the_twin(reported: Reported) -> None:
    """The twin has no friction and less noise: the emulator's motor warms up slightly earlier."""
    predicted = predict(PaperLoad())
    assert predicted is not None
    assert predicted.motor == "motor2"
    assert predicted.lasting_torque_nm == pytest.approx(LASTING_NM)
    assert predicted.torque_nm > 1.8
    assert 0.6 * predicted.seconds < reported.seconds < 1.4 * predicted.seconds


def predict(*loads: Load) -> Endurance | None:
    bench = read_bench(EMULATOR_BENCH)
    return find_endurance(bench, build_bench_configuration(bench, FIGURE), loads)


@pytest.mark.parametrize(
    "load",
    [
        MassLoad(),
        ConstantLoad(torque_nm=(0.0, 0.0, 1.1)),
        PulseLoad(torque_nm=(0.0, 0.0, 2.0), duration_s=2.0),
    ],
)
def test_continuous_load_has_no_predicted_fault(load: Load) -> None:
    assert predict(load) is None


def test_two_continuous_loads_may_exceed_the_limit_together() -> None:
    half = ConstantLoad(torque_nm=(0.0, 0.0, 1.0))
    assert predict(half) is None
    both = predict(half, half)
    assert both is not None
    assert both.torque_nm == pytest.approx(2.0, abs=0.05)

"""The bench's own loop on the emulator of every actuator with two motors, in lockstep."""

import json
from collections.abc import Callable
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from svsa.actuators.installed import get_mechanism, list_mechanism_names
from svsa.actuators.signals import CHANNEL_INDEX, Disturbance, State, Torque
from svsa.errors import ParameterError
from svsa.hardware.bench.real_motors import RealMotors
from svsa.hardware.description.calibration import find_calibration, list_problems
from svsa.hardware.description.file import read_bench
from svsa.hardware.emulator.bench_file import write_bench
from svsa.hardware.emulator.experiment import LockstepBench
from svsa.hardware.emulator.launch import start_emulator
from svsa.hardware.emulator.parameters import build_emulator_parameters
from svsa.hardware.realtime.configuration import (
    build_bench_configuration,
    build_first_experiment,
    build_guard,
    read_bench_design,
)
from svsa.hardware.realtime.prepared_laws import (
    PreparedLaws,
    UnpreparedLawError,
    compute_constants,
)
from svsa.hardware.safety.machine import BenchStatus
from svsa.runs.definition.experiment import build_actuator_experiment, build_default_load
from svsa.runs.definition.paper import get_figure
from svsa.runs.execution.run import Run
from tests.hardware.emulator.in_process_emulator import start_in_process

OTHERS = [
    name
    for name in list_mechanism_names()
    if name != "svsa" and get_mechanism(name).has_stiffness_motor
]
TICKS, LOADED = 3500, 1500
SETTLED = slice(3000, TICKS)


def run(
    folder: Path,
    name: str,
    law: str,
    start: Callable[[str], AbstractContextManager[Any]] = start_in_process,
    ticks: int = TICKS,
) -> np.ndarray:
    """Samples of the default experiment of an actuator, with its default load at `LOADED`."""
    path, parameters = folder / "bench.toml", build_emulator_parameters(name)
    with start(name) as emulator:
        bench = write_bench(path, parameters, emulator.port, 1, lockstep=True)
        wanted = build_actuator_experiment(name, law, load=False)
        loop = LockstepBench(emulator, wanted, ticks, bench)
        try:
            loop.prepare()
            loop.start()
            load = build_default_load(get_mechanism(name)).changed(start_s=None)
            emulator.control.load(load, at_s=loop.now() + 0.001 * LOADED)
            loop.tick(ticks)
            assert loop.plant.fault is None, loop.plant.fault
            assert loop.plant.status is BenchStatus.RUN
            assert loop.plant.emulated
        finally:
            loop.close()
        return loop.sink.samples


def start_process(name: str) -> AbstractContextManager[Any]:
    return start_emulator(True, 120.0, "--actuator", name)


def read_settled(samples: np.ndarray, name: str) -> np.ndarray:
    return samples[SETTLED, CHANNEL_INDEX[name]]


@pytest.mark.exhaustive
@pytest.mark.parametrize("name", OTHERS)
def test_ndobc_holds_the_load_on_the_emulated_bench(name: str, tmp_path: Path) -> None:
    """1.5 s after the load ŵ is the load, and the error is less than half of that of FL."""
    compensated, plain = (run(tmp_path, name, law) for law in ("ndobc", "fl"))
    assert np.all(np.isfinite(compensated[:, CHANNEL_INDEX["position_rad"]]))
    load = build_default_load(get_mechanism(name)).torque_nm[0]
    seen = np.mean(read_settled(compensated, "estimate_link_nm"))
    assert seen == pytest.approx(load, rel=0.25)
    error, of_fl = (
        np.max(np.abs(read_settled(one, "position_error_rad"))) for one in (compensated, plain)
    )
    assert error < 0.5 * of_fl
    assert np.degrees(error) < 0.2
    wrong = np.abs(read_settled(compensated, "stiffness_error_nm_per_rad"))
    assert np.max(wrong / read_settled(compensated, "stiffness_reference_nm_per_rad")) < 0.05


@pytest.mark.exhaustive
def test_run_over_sockets_gives_the_same_samples_bit_for_bit(tmp_path: Path) -> None:
    """`svsa emulator --actuator qbmove` as a process of its own, over python-can."""
    over_wire, here = (
        run(tmp_path, "qbmove", "ndobc", start, 600) for start in (start_process, start_in_process)
    )
    assert np.array_equal(over_wire, here, equal_nan=True)


def test_written_bench_file_is_calibrated_and_selects_the_actuator(tmp_path: Path) -> None:
    for name in OTHERS:
        path = tmp_path / f"{name}.toml"
        write_bench(path, build_emulator_parameters(name), 29536, 29537, lockstep=False)
        bench = read_bench(path)
        assert list_problems(bench, find_calibration(bench)) == []
        design, mechanism = read_bench_design(bench), get_mechanism(name)
        assert (design.actuator, design.limits) == (mechanism.prototype, mechanism.limits)
        first = build_bench_configuration(bench, build_first_experiment(bench))
        assert first.actuator == mechanism.prototype
        assert first.gains == design.gains


def test_antagonistic_bench_limits_each_real_motor(tmp_path: Path) -> None:
    """6 N·m a motor: u1 = 12 and u2 = 0, or u1 = 6 and u2 = 6, and never both."""
    path = tmp_path / "bench.toml"
    bench = write_bench(path, build_emulator_parameters("qbmove"), 1, 2, lockstep=True)
    guard = build_guard(bench.changed(safety=bench.safety.changed(torque_rate_nm_per_s=1e6)))
    still = State(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    assert guard.limit(Torque(20.0, 0.0), still) == pytest.approx((12.0, 0.0))
    assert guard.limit(Torque(20.0, 20.0), still) == pytest.approx((6.0, 6.0))
    # Motor a turns by θ1 + θ2: beyond its end, although each coordinate alone is within.
    end = bench.motor1.position_max_rad
    beyond = still._replace(q=0.7 * end, theta1=0.7 * end, theta2=0.7 * end)
    assert guard.limit(Torque(2.0, 2.0), beyond) == pytest.approx((0.0, 0.0))
    alarm = guard.check_motion(still._replace(theta1=0.6 * end, theta2=0.6 * end))
    assert alarm is not None
    assert (alarm.code, next(iter(alarm.values))) == ("position_limit", "motor1_position_rad")


def test_frozen_encoder_of_an_antagonistic_motor_is_detected(
    tmp_path: Path,
) -> None:
    """ŵ4 and ŵ6 that grow alike are a torque on motor a alone."""
    path = tmp_path / "bench.toml"
    guard = build_guard(write_bench(path, build_emulator_parameters("qbmove"), 1, 2, True))
    still, guard.counts = State(0.0, 0.0, 0.0, 0.0, 0.0, 0.0), (5, 7, 9)
    assert guard.check(Torque(0.0, 0.0), still, Disturbance(0.0, 0.0, 0.0)) is None
    alarm = guard.check(Torque(0.0, 0.0), still, Disturbance(0.0, 3.0, 3.0))
    assert alarm is not None
    assert (alarm.code, next(iter(alarm.values))) == ("encoder_frozen", "motor1_counts")


def test_motors_and_coordinates_of_a_pair_are_the_inverse_of_each_other() -> None:
    """Power is the same in both: ua θ̇a + ub θ̇b = u1 θ̇1 + u2 θ̇2."""
    pair, u = RealMotors(is_pair=True), Torque(3.0, -1.0)
    assert pair.find_coordinates(*pair.find_angles(0.3, -0.7)) == pytest.approx((0.3, -0.7))
    assert pair.join(pair.split(u)) == pytest.approx(u)
    da, db = pair.find_angles(2.0, 5.0)
    motors = pair.split(u)
    assert motors.u1 * da + motors.u2 * db == pytest.approx(u.u1 * 2.0 + u.u2 * 5.0)


def test_actuator_that_a_bench_cannot_drive_is_rejected_with_reason(tmp_path: Path) -> None:
    path = tmp_path / "bench.toml"
    bench = write_bench(path, build_emulator_parameters("qbmove"), 1, 2, lockstep=True)

    def rename(actuator: str) -> Any:
        return bench.changed(design=bench.design.changed(actuator=actuator))

    with pytest.raises(ParameterError, match="two motors: a bench has two drives"):
        build_emulator_parameters("sea")
    with pytest.raises(ParameterError, match="two motors: a bench has two drives"):
        read_bench_design(rename("sea"))
    with pytest.raises(ParameterError, match=r"design\.actuator is 'qbmov': .*qbmove"):
        read_bench_design(rename("qbmov"))
    with pytest.raises(ParameterError, match=r"home\.lever_ratio is 0\.513.*less than 0\.09953"):
        read_bench_design(rename("maccepa"))
    with pytest.raises(ParameterError, match="it must be qbmove, the actuator of this bench"):
        build_bench_configuration(bench, get_figure("4a").build_configuration())


def test_constants_that_a_loop_lacks_come_from_another_process_with_its_addresses() -> None:
    """The functions of an energy are at other addresses there: those of the loop are never used."""
    configuration = build_actuator_experiment("qbmove", "lqi", load=False)
    laws, lane, blocks = PreparedLaws(), configuration.lanes[0], Run(configuration).blocks[0]
    strange = {"torques_address": 1, "margin_address": 2, "state_address": 3}
    elsewhere = blocks._replace(nominal=blocks.nominal._replace(**strange))
    laws.bind(configuration, lane, blocks)
    laws.close()
    with pytest.raises(UnpreparedLawError) as lacking:
        laws.bind(configuration, lane, elsewhere)
    sent = json.loads(json.dumps(lacking.value.arguments))
    laws.add(json.loads(json.dumps(compute_constants(sent))))
    bound, own = laws.bind(configuration, lane, elsewhere), laws.bind(configuration, lane, blocks)
    assert not np.array_equal(bound.nominal, own.nominal)
    assert np.array_equal(bound.constants, own.constants)

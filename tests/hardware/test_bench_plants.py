"""One contract for all plants behind read and write: a simulated one, and those on the wire.

Every plant gives a controller the same guarantees: signs, limits, states, and the reported torque
that was sent.
"""

import math
from collections.abc import Iterator

import numpy as np
import pytest

from svsa.actuators.signals import CHANNEL_INDEX, Torque
from svsa.errors import StateError
from svsa.hardware.emulator.launch import RunningEmulator, start_emulator
from svsa.hardware.safety.machine import BenchStatus
from tests.exhaustive import exhaust
from tests.hardware.plant_stand import MOTEUS, NO_TORQUE, Stand, stand_emulated, stand_simulated

PLANTS = ("simulated", "socketcand", "moteus", "slcan")
TRACKED_RAD = math.radians(0.5)
TRACKED_NM_PER_RAD = 1.0


@pytest.fixture(scope="module")
def emulator() -> Iterator[RunningEmulator]:
    with start_emulator(lockstep=True) as running:
        yield running


@pytest.fixture(scope="module")
def moteus() -> Iterator[RunningEmulator]:
    with start_emulator(True, 120.0, "--file", str(MOTEUS / "emulator.toml")) as running:
        yield running


@pytest.fixture(params=exhaust(PLANTS, PLANTS[:2]))
def stand(
    request: pytest.FixtureRequest, emulator: RunningEmulator, moteus: RunningEmulator
) -> Iterator[Stand]:
    if request.param == "simulated":
        yield from stand_simulated()
    else:
        wired = moteus if request.param == "moteus" else emulator
        yield from stand_emulated(wired, request.param)


def test_plant_at_rest_stays_at_rest(stand: Stand) -> None:
    stand.start()
    stand.push(NO_TORQUE, 200)
    assert stand.plant.status is BenchStatus.RUN
    assert np.max(np.abs(stand.x)) < 1e-9
    assert stand.reading is not None
    assert stand.reading.measurement is not None
    assert np.max(np.abs(stand.reading.measurement)) < 1e-9


@pytest.mark.parametrize("number", [0, 1])
def test_positive_torque_first_increases_the_angle_of_its_own_motor(
    stand: Stand, number: int
) -> None:
    """And φ = q − θ1 decreases where θ1 leads the link."""
    stand.start()
    torque = Torque(1.0, 0.0) if number == 0 else Torque(0.0, 1.0)
    sent = stand.push(torque, 20)
    assert sent[number] == pytest.approx(1.0, abs=0.001)
    assert sent[1 - number] == 0.0
    x = stand.x
    moved, others = (x.theta1, (x.theta2,)) if number == 0 else (x.theta2, (x.theta1, x.q))
    assert moved > 0.001
    assert all(abs(other) < 0.05 * moved for other in others)
    assert stand.reading is not None
    y = stand.reading.measurement
    assert y is not None
    seen = y.theta1 if number == 0 else y.theta2
    assert seen == pytest.approx(moved, rel=0.25)
    if number == 0:
        assert x.q < x.theta1
        assert y.phi < 0.0
        assert y.phi == pytest.approx(x.q - x.theta1, abs=0.004)


def test_reported_torque_is_the_target_torque_of_the_motors(stand: Stand) -> None:
    """To the last mA: rounding and the limits of 15 and 5 N·m are known to the observer."""
    stand.start()
    sent = stand.push(Torque(0.123456, -0.0654321), 5)
    stand.go_on()
    assert stand.targets == pytest.approx(list(sent), abs=1e-12)
    assert sent != Torque(0.123456, -0.0654321)
    per_ma = [50.0 * 0.9 * 0.0396e-3, 50.0 * 0.9 * 0.0234e-3]
    assert sent == pytest.approx((0.123456, -0.0654321), abs=0.5 * max(per_ma))
    whole = np.divide(sent, per_ma)
    assert np.max(np.abs(whole - np.round(whole))) < 1e-6
    assert stand.push(Torque(100.0, -100.0)) == pytest.approx((15.0, -5.0), abs=0.002)
    stand.go_on()
    assert stand.targets == pytest.approx([15.0, -5.0], abs=0.002)


def test_non_finite_torque_is_rejected(stand: Stand) -> None:
    stand.start()
    stand.push(Torque(0.5, 0.1), 5)
    assert stand.push(Torque(math.nan, 0.0)) == NO_TORQUE
    assert stand.plant.fault.code == "not_finite"
    stand.push(Torque(0.5, 0.1), 3)
    assert stand.targets == [0.0, 0.0]
    with pytest.raises(StateError):
        stand.plant.start(stand.now)


def test_stop_ramps_to_zero(stand: Stand) -> None:
    stand.start()
    wanted = Torque(0.3, 0.1)
    stand.push(wanted, 5)
    stand.plant.stop(stand.now, "a test")
    sent = [stand.push(wanted).u1 for _ in range(310)]
    assert stand.plant.status is BenchStatus.READY
    assert sent[0] == pytest.approx(wanted.u1, abs=0.01)
    assert sent[150] == pytest.approx(0.5 * wanted.u1, abs=0.01)
    assert np.all(np.diff(sent) <= 1e-12)
    assert sent[-1] == 0.0
    assert stand.plant.fault is None
    stand.go_on()
    assert stand.targets == [0.0, 0.0]


def test_closed_plant_makes_no_torque_and_has_no_mode(stand: Stand) -> None:
    stand.start()
    stand.push(Torque(0.5, 0.1), 5)
    stand.plant.close()
    assert stand.targets == [0.0, 0.0]
    assert not any(stand.describe()[2]), "no mode, or stopped"


@pytest.mark.exhaustive
def test_plant_follows_a_second_of_figure_4a(stand: Stand) -> None:
    """Through encoders, currents and the wire within half a degree, and 1 N·m/rad at the end."""
    stand.start(by_hand=False)
    stand.tick(1000)
    assert stand.plant.status is BenchStatus.RUN, stand.plant.fault
    samples = stand.sink.samples[:1000]
    assert np.max(np.abs(samples[:, CHANNEL_INDEX["position_error_rad"]])) < TRACKED_RAD
    stiffness = samples[-1, CHANNEL_INDEX["stiffness_error_nm_per_rad"]]
    assert abs(stiffness) < TRACKED_NM_PER_RAD
    true = samples[-1, CHANNEL_INDEX["position_reference_rad"]]
    assert stand.x.q == pytest.approx(true, abs=TRACKED_RAD)

"""Identification from a CSV file of measured angles and torques."""

import math

import numpy as np
import pytest

import svsa
from svsa.actuators.signals import CHANNEL_INDEX
from svsa.analysis.identification.record import IdentificationError
from svsa.errors import ParameterError

from .excited_run import BENCH, DESIGN, build_configuration, play

COLUMNS = ("time_s", "motor1_position_rad", "motor2_position_rad", "deflection_rad")
TORQUES = ("torque1_nm", "torque2_nm")
COUNTS = (2000 * 50, 2000 * 50, 8000)


def write(path, samples, names=(*COLUMNS, *TORQUES), **factors):
    rows = np.stack([samples[:, CHANNEL_INDEX[name]] for name in (*COLUMNS, *TORQUES)], axis=1)
    for column, counts in enumerate(COUNTS, start=1):
        step = 2.0 * math.pi / counts
        rows[:, column] = np.round(rows[:, column] / step) * step * factors.get(names[column], 1.0)
    np.savetxt(path, rows, delimiter=",", header=",".join(names), comments="", fmt="%.9g")
    return path


@pytest.fixture(scope="module")
def samples():
    found, fault = play(build_configuration(effects=BENCH.changed(current_lag=None)))
    assert fault is None
    return found


@pytest.mark.exhaustive
@pytest.mark.parametrize("share", [0.6, 1.0, 1.7])
def test_csv_file_gives_the_parameters_from_any_assumed_spring(samples, tmp_path, share):
    names = ("time_s", "motor1_position_rad", "motor2_position_rad", "deflection_deg", *TORQUES)
    path = write(tmp_path / "mine.csv", samples, names, deflection_deg=180.0 / math.pi)
    true = DESIGN.actuator
    assumed = true.changed(spring_stiffness_n_per_m=share * true.spring_stiffness_n_per_m)
    parameters = DESIGN.changed(actuator=assumed)
    found = svsa.identify(path, stiffness_nm_per_rad=30.0, parameters=parameters)
    for name in ("link_inertia_kg_m2", "motor1_inertia_kg_m2", "spring_stiffness_n_per_m"):
        assert found.estimates[name].value == pytest.approx(getattr(true, name), rel=0.02), name
    spring = found.estimates["spring_stiffness_n_per_m"]
    assert spring.low < true.spring_stiffness_n_per_m < spring.high
    assert spring.relative_width < 0.01
    assert found.run_id == str(path)


def move(actuator, sigma, ticks, seed):
    """Time, θ1, θ2, φ, u1, u2 (ticks, 6) of the printed equations, with torques held for 1 ms."""
    a, step = actuator, 0.001
    K = a.spring_stiffness_n_per_m * a.radius_m**2
    r, gear = math.sqrt(sigma / K), 2.0 * math.pi * a.spiral_reduction
    rates, phases = (0.3, 0.7, 1.3, 2.1, 3.7, 5.3), np.random.default_rng(seed).uniform(0, 6.28, 6)

    def differentiate(x, u1, u2):
        c, s, mu = math.cos(x[0] - x[2]), math.sin(x[0] - x[2]), r / (1.0 + r) + x[4] / gear
        elastic = K * mu**2 * s * c / (1.0 - mu * c) ** 2
        reaction = K * mu * ((1.0 - mu) ** -2 - (c / (1.0 - mu * c)) ** 2) / gear
        return np.array([
            x[1], (-elastic - a.link_damping_nms_per_rad * x[1]) / a.link_inertia_kg_m2,
            x[3], (u1 + elastic - a.motor1_damping_nms_per_rad * x[3]) / a.motor1_inertia_kg_m2,
            x[5], (u2 - reaction - a.motor2_damping_nms_per_rad * x[5]) / a.motor2_inertia_kg_m2,
        ])  # fmt: skip

    rows, x = np.empty((ticks, 6)), np.zeros(6)
    for tick in range(ticks):
        t = step * tick
        r1, r2 = 0.4 * math.sin(2.5 * t), 0.25 * math.sin(3.1 * t) + 0.1 * math.sin(10.7 * t)
        u1 = 0.45 * np.sin(2.0 * math.pi * t * np.array(rates) + phases).sum() + 3.0 * (r1 - x[2])
        u = u1 - 0.02 * x[3], 4.0 * (r2 + 0.05 * math.sin(19.5 * t) - x[4]) - 0.1 * x[5]
        rows[tick] = t, x[2], x[4], x[0] - x[2], *u
        k1 = differentiate(x, *u)
        k2 = differentiate(x + 0.5 * step * k1, *u)
        k3 = differentiate(x + 0.5 * step * k2, *u)
        x = x + step / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + differentiate(x + step * k3, *u))
    return rows


@pytest.mark.exhaustive
@pytest.mark.parametrize("noise_rad", [2e-4, 0.0])
def test_spring_of_other_equations_is_in_its_interval(tmp_path, noise_rad):
    """With the encoders' counts, or noise instead; the assumed spring is 1882 N/m."""
    actuator = DESIGN.actuator.changed(spring_stiffness_n_per_m=1700.0)
    rows = move(actuator, 25.0, 20_000, seed=3)
    if noise_rad:
        rows[:, 1:4] += np.random.default_rng(3).normal(0.0, noise_rad, (len(rows), 3))
    else:
        counts = np.array(COUNTS) / (2.0 * math.pi)
        rows[:, 1:4] = np.round(rows[:, 1:4] * counts) / counts
    path = tmp_path / "own.csv"
    head = ",".join((*COLUMNS, *TORQUES))
    np.savetxt(path, rows, delimiter=",", header=head, comments="", fmt="%.9g")
    spring = svsa.identify(path, stiffness_nm_per_rad=25.0).estimates["spring_stiffness_n_per_m"]
    assert spring.low < 1700.0 < spring.high
    assert spring.relative_width < 0.01


def test_invalid_file_error_names_column_row_and_bound(samples, tmp_path):
    short = write(tmp_path / "short.csv", samples[:2000])
    with pytest.raises(IdentificationError, match="at least 6 s"):
        svsa.identify(short, stiffness_nm_per_rad=30.0)
    with pytest.raises(ParameterError, match="stiffness_nm_per_rad"):
        svsa.identify(short)
    gap = write(tmp_path / "gap.csv", np.delete(samples[:3000], 1000, axis=0))
    with pytest.raises(ParameterError, match="time_s in row 1002"):
        svsa.identify(gap, stiffness_nm_per_rad=30.0)
    text = short.read_text().replace("deflection_rad", "phi")
    (tmp_path / "head.csv").write_text(text)
    with pytest.raises(ParameterError, match="deflection_rad or deflection_deg"):
        svsa.identify(tmp_path / "head.csv", stiffness_nm_per_rad=30.0)
    with pytest.raises(ParameterError, match="readable CSV"):
        svsa.identify(tmp_path / "none.csv", stiffness_nm_per_rad=30.0)
    for column in (0, 1, 5):
        rows = [line.split(",") for line in short.read_text().splitlines()]
        rows[4][column] = '"0,5"'
        (tmp_path / "comma.csv").write_text("\n".join(map(",".join, rows)))
        pattern = f"{rows[0][column]} in row 5 is '0,5': .*decimal point"
        with pytest.raises(ParameterError, match=pattern):
            svsa.identify(tmp_path / "comma.csv", stiffness_nm_per_rad=30.0)
    (tmp_path / "semicolon.csv").write_text(short.read_text().replace(",", ";").replace(".", ","))
    with pytest.raises(ParameterError, match="separated by a comma"):
        svsa.identify(tmp_path / "semicolon.csv", stiffness_nm_per_rad=30.0)
    lines = short.read_text().splitlines()
    lines[9] = lines[9].rpartition(",")[0] + ","
    (tmp_path / "empty.csv").write_text("\n".join(lines))
    with pytest.raises(ParameterError, match="torque2_nm in row 10"):
        svsa.identify(tmp_path / "empty.csv", stiffness_nm_per_rad=30.0)


def test_simulated_result_is_identified_without_a_record(samples):
    with pytest.raises(IdentificationError, match="at least 6 s"):
        svsa.identify(svsa.simulate("4a", duration_s=1.0))


@pytest.mark.parametrize("actuator", ["sea", "awas2"])
def test_other_actuator_is_rejected_by_its_name(actuator):
    run = svsa.simulate("4a", actuator=actuator, loads=[], duration_s=0.01)
    with pytest.raises(IdentificationError, match=f"has the actuator {actuator}: only"):
        svsa.identify(run)

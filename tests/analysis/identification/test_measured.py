"""Identification from a CSV file of measured angles and torques."""

import math

import numpy as np
import pytest

import svsa
from svsa.actuators.signals import CHANNEL_INDEX
from svsa.analysis.identification.record import IdentificationError
from svsa.errors import ParameterError

from .excited_run import BENCH, build_configuration, play

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
def test_csv_file_gives_the_parameters_of_the_actuator(samples, tmp_path):
    names = ("time_s", "motor1_position_rad", "motor2_position_rad", "deflection_deg", *TORQUES)
    path = write(tmp_path / "mine.csv", samples, names, deflection_deg=180.0 / math.pi)
    found = svsa.identify(path, stiffness_nm_per_rad=30.0)
    true = svsa.load_prototype().actuator
    for name in ("link_inertia_kg_m2", "motor1_inertia_kg_m2", "spring_stiffness_n_per_m"):
        assert found.estimates[name].value == pytest.approx(getattr(true, name), rel=0.02), name
    assert found.run_id == str(path)


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

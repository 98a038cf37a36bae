"""The samples of a recorded run over REST: as files, decimated, and a segment of them."""

import io

import httpx
import numpy as np
import pyarrow.parquet as pq
import pytest

from svsa.runs.records.catalogue.runs import Catalogue
from svsa.runs.records.decimation import decimate
from tests.runs.records.records import build_samples
from tests.server.routes.runs.conftest import FIRST_TICK, POSITION


@pytest.mark.parametrize("kind", ["csv", "parquet", "mat", "mcap"])
def test_exports_are_files(client: httpx.Client, catalogue: Catalogue, kind: str) -> None:
    answer = client.get("runs/run-1/export", params={"kind": kind}).raise_for_status()
    assert answer.headers["content-disposition"] == f'attachment; filename="Run_1_run-1.{kind}"'
    assert int(answer.headers["content-length"]) == len(answer.content)
    starts = {"csv": b'"tick"', "parquet": b"PAR1", "mat": b"MATLAB 5.0", "mcap": b"\x89MCAP"}
    assert answer.content.startswith(starts[kind])
    if kind == "parquet":
        table = pq.read_table(io.BytesIO(answer.content))
        samples = catalogue.open("run-1").samples
        assert table["fl.position_rad"].to_numpy().tobytes() == samples[:, 1, POSITION].tobytes()


def test_decimation_keeps_every_peak(client: httpx.Client) -> None:
    query = {"channels": "position_rad,torque1_nm", "points": 100}
    answer = client.get("runs/run-1/samples", params=query).raise_for_status().json()
    assert set(answer["lanes"]) == {"ndobc", "fl"}
    assert set(answer["lanes"]["fl"]) == {"position_rad", "torque1_nm"}
    assert len(answer["time_s"]) == len(answer["lanes"]["fl"]["position_rad"]) == 100
    assert (answer["stride"], answer["first_tick"]) == (100, FIRST_TICK)
    assert max(answer["lanes"]["fl"]["position_rad"]) == 1e6
    at = answer["lanes"]["fl"]["position_rad"].index(1e6)
    assert answer["time_s"][at] == pytest.approx(1 + 3.333, abs=0.1)
    assert answer["time_s"] == sorted(answer["time_s"])


def test_short_segment_is_complete(client: httpx.Client, catalogue: Catalogue) -> None:
    query = {"channels": "position_rad", "start_s": 1.005, "end_s": 1.015}
    answer = client.get("runs/run-1/samples", params=query).raise_for_status().json()
    assert (answer["stride"], answer["first_tick"]) == (1, 1005)
    expected = catalogue.open("run-1").samples[5:15, :, POSITION]
    assert answer["lanes"]["fl"]["position_rad"] == expected[:, 1].tolist()
    assert answer["lanes"]["ndobc"]["position_rad"][5] is None
    assert answer["time_s"] == pytest.approx([1.005 + 0.001 * k for k in range(10)])
    beyond = client.get("runs/run-1/samples", params={"start_s": 100}).raise_for_status().json()
    assert beyond["time_s"] == []
    assert "torque1_nm" in beyond["lanes"]["ndobc"]


@pytest.mark.parametrize("points", [2, 3, 10, 99, 100, 5000])
def test_decimation_keeps_minimum_and_maximum(points: int) -> None:
    values = build_samples(997)[:, :, :3]
    thinned = decimate(values, points)
    assert len(thinned.rows) == len(thinned.values) <= points
    np.testing.assert_array_equal(thinned.values.min(0), values.min(0))
    np.testing.assert_array_equal(thinned.values.max(0), values.max(0))
    assert np.all(np.diff(thinned.rows) >= 0)
    assert decimate(np.empty((0, 2, 3)), points).values.shape == (0, 2, 3)

"""References over REST: a CSV is read and a reference previewed without a change."""

import math

import pytest
from fastapi.testclient import TestClient

from svsa_server.app import build_app

CSV = "time_s,position_deg\n0,0\n0.5,10\n1,0\n"


@pytest.fixture(scope="module")
def client() -> TestClient:
    return TestClient(build_app(), base_url="http://127.0.0.1")


def read(client: TestClient, text: str) -> dict:
    headers = {"Content-Type": "text/csv"}
    answer = client.post("/api/v1/references/csv", content=text, headers=headers)
    return {"status": answer.status_code, **answer.json()}


def test_csv_becomes_a_reference_and_is_previewed(client: TestClient) -> None:
    series = read(client, CSV)
    assert series["follows"] == "position"
    assert series["reference"]["position_rad"] == pytest.approx([0.0, math.radians(10.0), 0.0])
    path = "/api/v1/references/preview"
    wanted = {name: series[name] for name in ("follows", "reference")}
    preview = client.post(path, json=wanted).raise_for_status().json()
    assert (preview["time_s"][0], preview["time_s"][-1]) == (0.0, 1.0)
    assert preview["high"] == pytest.approx(math.radians(10.0), rel=1e-3)
    assert max(preview["value"]) == pytest.approx(preview["high"], rel=1e-3)
    assert preview["peak_rate"] > math.radians(20.0), "faster than the straight lines between"


def test_invalid_csv_is_rejected_with_its_row(client: TestClient) -> None:
    refused = read(client, CSV + "0.9,1\n")
    assert refused["status"] == 422
    assert "time_s in row 5 is 0.9 s" in refused["detail"]
    assert "1 s" in refused["violations"][0]["bound"]


@pytest.mark.parametrize(
    ("reference", "duration", "low", "high"),
    [
        ({"kind": "steps", "time_s": [0, 2], "stiffness_nm_per_rad": [15, 60]}, 2.2, 15, 60),
        ({"kind": "constant", "stiffness_nm_per_rad": 20}, 1.0, 20, 20),
        (
            {
                "kind": "chirp",
                "offset_nm_per_rad": 30,
                "amplitude_nm_per_rad": 5,
                "start_hz": 0.1,
                "end_hz": 1,
                "duration_s": 7,
            },
            7.0,
            25,
            35,
        ),
    ],
)
def test_every_kind_is_previewed(
    client: TestClient, reference: dict, duration: float, low: float, high: float
) -> None:
    numbers = {key: _floats(value) for key, value in reference.items()}
    path = "/api/v1/references/preview"
    preview = (
        client.post(path, json={"follows": "stiffness", "reference": numbers})
        .raise_for_status()
        .json()
    )
    assert preview["time_s"][-1] == pytest.approx(duration)
    assert (preview["low"], preview["high"]) == (low, high)


def _floats(value: object) -> object:
    if isinstance(value, list):
        return [float(item) for item in value]
    return value if isinstance(value, str) else float(value)  # pyright: ignore[reportArgumentType]

"""The origin of a run and the metrics of a segment over REST, for the scripts of the page."""

from pathlib import Path

import pytest

from svsa.runs.metrics.metrics import compute_metrics
from svsa.runs.records.reader import open_record
from tests.lab import Lab
from tests.lab_in_process import run_lab_in_process
from tests.waiting import follow_recording

ONSET_S = 2.0


def record(lab: Lab) -> tuple[str, dict]:
    """Record 4 s from t = 0, FL and NDOBC, a load at 2 s; return its id and the live origin."""
    lab.load_figure()
    lab.client.post(lab.session + "/pause").raise_for_status()
    lab.client.post(lab.session + "/reset").raise_for_status()
    lab.client.put(lab.session + "/lanes", json={"comparisons": [{"law": "fl"}]}).raise_for_status()
    recording = lab.client.post(lab.session + "/recording", json={}).raise_for_status().json()
    lab.jump(ONSET_S)
    lab.client.post(lab.session + "/loads", json={"kind": "paper"}).raise_for_status()
    lab.jump(2)
    origin = lab.client.get(lab.session + "/origin").raise_for_status().json()
    lab.client.delete(lab.session + "/recording").raise_for_status()
    lab.client.put(lab.session + "/lanes", json={"comparisons": []}).raise_for_status()
    run = recording["recording"]["run_id"]
    follow_recording(lab.client, f"/api/v1/runs/{run}")
    return run, origin


def test_origin_of_a_recorded_run_is_that_of_its_session(lab: Lab) -> None:
    run, live = record(lab)
    recorded = lab.client.get(f"/api/v1/runs/{run}/origin").raise_for_status().json()
    assert recorded == live
    assert [(c["tick"], c["command"]["kind"]) for c in live["commands"]] == [
        (0, "comparisons"),
        (2000, "load"),
    ]
    assert (live["tick"], live["period_s"], live["plant"]) == (4000, 0.001, "simulated")
    assert live["first_tick"] == 0
    assert live["configuration"] == live["defaults"]


def test_origin_of_a_run_reports_the_start_of_its_record(lab: Lab) -> None:
    """The script of a short recording of a long session also simulates the time before it."""
    lab.load_figure()
    lab.jump(3)
    first = lab.read()["tick"]
    recording = lab.client.post(lab.session + "/recording", json={}).raise_for_status().json()
    run = recording["recording"]["run_id"]
    lab.jump(1)
    lab.client.delete(lab.session + "/recording").raise_for_status()
    follow_recording(lab.client, f"/api/v1/runs/{run}")

    origin = lab.client.get(f"/api/v1/runs/{run}/origin").raise_for_status().json()

    assert (origin["first_tick"], origin["tick"]) == (first, first + 1000)


def test_metrics_of_a_segment_are_those_of_its_samples(tmp_path: Path) -> None:
    with run_lab_in_process(data=str(tmp_path)) as lab:
        run, _ = record(lab)
        query = {"start_s": ONSET_S, "end_s": 3.5}
        answer = lab.client.get(f"/api/v1/runs/{run}/metrics", params=query).raise_for_status()
        reported = answer.json()
        whole = lab.client.get(f"/api/v1/runs/{run}/metrics").json()
        under_load = lab.client.get(f"/api/v1/runs/{run}/metrics?start_s={ONSET_S}").json()
        entry = lab.client.get(f"/api/v1/runs/{run}").json()
        refused = lab.client.get(f"/api/v1/runs/{run}/metrics", params={"start_s": 2, "end_s": 1})
    assert (reported["start_s"], reported["end_s"]) == (ONSET_S, 3.5)
    samples = open_record(tmp_path / "runs" / run).samples[2000:3500]
    for number, metrics in enumerate(reported["lanes"].values()):
        expected = compute_metrics(samples[:, number], 0.001)
        assert metrics["rms_position_error_rad"] == pytest.approx(expected.rms_position_error_rad)
        assert metrics["peak_torque1_nm"] == expected.peak_torque1_nm
    assert [window["label"] for window in whole["windows"]] == ["", "3 kg load"]
    assert [window["label"] for window in under_load["windows"]] == ["3 kg load"]
    assert (entry["window"]["label"], entry["window"]["start_s"]) == ("3 kg load", ONSET_S)
    for metrics, listed in zip(under_load["lanes"].values(), entry["metrics"], strict=True):
        assert metrics["rms_position_error_rad"] == pytest.approx(listed["rms_position_error_rad"])
    assert refused.status_code == 422


def test_replay_is_a_page_for_inline_display(lab: Lab) -> None:
    run, _ = record(lab)
    answer = lab.client.get(f"/api/v1/runs/{run}/replay?t=1.5").raise_for_status()
    assert "frame-ancestors 'self'" in answer.headers["Content-Security-Policy"]
    assert answer.headers["content-type"].startswith("text/html")
    assert "content-disposition" not in answer.headers
    assert answer.headers["cache-control"].startswith("private")
    assert answer.headers["vary"] == "Cookie, Authorization, Accept-Encoding"
    assert lab.client.get("/api/v1/runs/no-such-run/replay").status_code == 404

"""Readiness, metrics, low disk space and the log in JSON."""

import json
import subprocess
import sys

from prometheus_client.parser import text_string_to_metric_families

from svsa_server.commands.serve import write_json_logs
from tests.lab_in_process import run_lab_in_process
from tests.server.access.classroom import run_class
from tests.waiting import wait_until

MORE_THAN_ANY_DISK_GB = "1e9"


def read_metrics(lab) -> dict[tuple[str, ...], float]:
    answer = lab.get("/metrics").raise_for_status()
    return {
        (sample.name, *sample.labels.values()): sample.value
        for family in text_string_to_metric_families(answer.text)
        for sample in family.samples
    }


def test_metrics_count_sessions_recordings_and_disk(tmp_path) -> None:
    with run_lab_in_process(data=str(tmp_path)) as running:
        lab = running.client
        before = read_metrics(lab)
        assert before["svsa_sessions", "simulated", "running"] == 1
        assert 0 < before["svsa_disk_free_bytes",] <= before["svsa_disk_size_bytes",]
        assert before["process_resident_memory_bytes",] > 1e7
        session = lab.post("/api/v1/sessions", json={}).raise_for_status().json()["session"]
        lab.post(f"/api/v1/sessions/{session}/recording", json={}).raise_for_status()
        after = read_metrics(lab)
        assert after["svsa_sessions", "simulated", "running"] == 2
        assert after["svsa_recordings",] == before["svsa_recordings",] + 1
        assert ("svsa_session_delay_seconds", session) in after


def test_metrics_name_a_private_session_only_to_its_owner_and_the_instructor(tmp_path) -> None:
    with run_class(tmp_path) as room:
        ada, bob, ola = room.join("Ada"), room.join("Bob"), room.join("Ola", "observer")
        session = ada.post("/api/v1/sessions", json={}).raise_for_status().json()["session"]
        for browser, is_named in ((ada, True), (room.log_in(), True), (bob, False), (ola, False)):
            metrics = read_metrics(browser)
            assert metrics["svsa_sessions", "simulated", "running"] == 2
            assert ("svsa_session_delay_seconds", "lab") in metrics
            text = browser.get("/metrics").text
            assert (session in text) == is_named


def test_lab_is_ready_until_the_disk_is_nearly_full(tmp_path, monkeypatch) -> None:
    with run_lab_in_process(data=str(tmp_path)) as running:
        answer = running.client.get("/api/v1/ready")
        assert (answer.status_code, answer.json()) == (200, {"ready": True, "problems": []})
        assert running.client.get("/api/v1/runs").json()["problem"] is None
    monkeypatch.setenv("SVSA_DISK_LOW_GB", MORE_THAN_ANY_DISK_GB)
    with run_lab_in_process(data=str(tmp_path)) as running:
        wait_until(lambda: running.client.get("/api/v1/ready").status_code == 503)
        (problem,) = running.client.get("/api/v1/ready").json()["problems"]
        assert problem.startswith("The disk is nearly full: ")
        assert running.client.get("/api/v1/runs").json()["problem"] == problem
        assert running.client.get("/api/v1/health").status_code == 200, "it is alive"


def test_lab_that_cannot_record_is_not_ready(tmp_path) -> None:
    (tmp_path / "runs").write_text("")
    with run_lab_in_process(data=str(tmp_path)) as running:
        answer = running.client.get("/api/v1/ready")
        assert answer.status_code == 503
        assert "Nothing can be recorded" in answer.json()["problems"][0]


def test_json_log_has_one_object_per_line() -> None:
    message = 'with "quotes"\nand a line'
    code = (
        f"import logging; from {write_json_logs.__module__} import write_json_logs;"
        f"write_json_logs(); logging.getLogger('svsa').warning({message!r})"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    (line,) = done.stderr.splitlines()
    read = json.loads(line)
    assert (read["message"], read["level"], read["logger"]) == (message, "WARNING", "svsa")
    assert read["time"]

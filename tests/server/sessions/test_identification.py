"""From the excitation to an own model: played, recorded, identified, used."""

import json
import subprocess
import sys

import pytest

import svsa
from svsa.analysis.identification.excitation import EXCITATION, EXCITATION_DURATION_S
from svsa.runs.definition.design_file import write_design
from svsa.runs.records.reader import open_record
from tests.lab import Lab, run_lab
from tests.waiting import follow

BENCH_LIKE = {"encoders": {}, "estimation": {}, "friction": {}, "current_lag": {}}
PATIENCE_S = 240.0


def run_command(*arguments: str, **settings: str) -> str:
    command = [sys.executable, "-c", "from svsa.cli import main; main()", *arguments]
    done = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE_S)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.exhaustive
def test_svsa_excite_records_the_input_of_svsa_identify(tmp_path) -> None:
    with run_lab(data=str(tmp_path)) as lab:
        lab.load_figure("4b")
        lab.client.put(lab.session + "/effects", json=BENCH_LIKE).raise_for_status()
        lab.client.put(lab.session + "/speed", json={"speed": 8}).raise_for_status()
        printed = run_command("excite", "--url", lab.url)
        run_id = printed.split()[1].rstrip(":")
        assert f"svsa identify {run_id}" in printed
        summary = lab.client.get(f"/api/v1/runs/{run_id}").json()
    assert summary["tags"] == ["identification"]
    folder = tmp_path / "runs" / run_id
    record = open_record(folder)
    assert record.duration_s == pytest.approx(EXCITATION_DURATION_S, abs=1.0)
    played = [
        command for _, command in record.commands if command["kind"] in ("position", "stiffness")
    ]
    assert len(played) == len(EXCITATION)
    found = json.loads(run_command("identify", str(folder), "--json"))
    assert found["undetermined"] == []
    actuator = svsa.load_prototype().actuator
    for name in ("link_inertia_kg_m2", "motor1_inertia_kg_m2", "spring_stiffness_n_per_m"):
        estimate = found["estimates"][name]["value"]
        assert estimate == pytest.approx(getattr(actuator, name), rel=0.05)


def test_excitation_is_rejected_under_a_load_and_during_a_recording(lab: Lab) -> None:
    lab.client.post(lab.session + "/loads", json={"kind": "paper"}).raise_for_status()
    refused = lab.client.post(lab.session + "/excitation", json={})
    assert refused.status_code == 409
    assert "load" in refused.json()["detail"]
    lab.client.delete(lab.session + "/loads").raise_for_status()
    lab.client.post(lab.session + "/recording", json={}).raise_for_status()
    refused = lab.client.post(lab.session + "/excitation", json={})
    assert refused.status_code == 409
    assert "recorded" in refused.json()["detail"]
    assert lab.client.delete(lab.session + "/recording").json()["excitation"] is None


@pytest.mark.parametrize("how", ["reference", "reset", "delete", "recording"])
def test_disturbed_excitation_is_cancelled_with_its_recording(lab: Lab, how: str) -> None:
    began = lab.client.post(lab.session + "/excitation", json={"name": "mine"})
    assert began.status_code == 201
    assert began.json()["recording"]["name"] == "mine"
    assert began.json()["excitation"]["duration_s"] == EXCITATION_DURATION_S
    again = lab.client.post(lab.session + "/excitation", json={})
    assert again.status_code == 409
    match how:
        case "reference":
            constant = {"kind": "constant", "position_rad": 0.1}
            lab.client.put(lab.session + "/position", json=constant).raise_for_status()
        case "reset":
            lab.client.post(lab.session + "/reset").raise_for_status()
        case "delete":
            lab.client.delete(lab.session + "/excitation").raise_for_status()
        case "recording":
            lab.client.delete(lab.session + "/recording").raise_for_status()
    ended = follow(lab.client, lab.session, lambda state: state["excitation"] is None)
    assert ended["recording"] is None


@pytest.mark.exhaustive
def test_parameter_file_is_the_model_in_library_server_and_session(lab: Lab, tmp_path) -> None:
    paper = svsa.load_prototype()
    mine = paper.changed(nominal=paper.actuator)
    path = tmp_path / "mine-design.toml"
    write_design(path, mine, "a test")
    assert svsa.simulate("4a", duration_s=0.01, parameters=path).configuration.nominal == (
        paper.actuator
    )
    answer = lab.client.put(lab.session + "/nominal", json={"toml": path.read_text("utf-8")})
    configuration = answer.raise_for_status().json()["configuration"]
    assert configuration["nominal"] == configuration["actuator"]
    before = lab.read()["configuration"]
    text = path.read_text("utf-8") + "\n[parameters.fl_integral]\nposition_pole_rad_per_s = 40.0\n"
    answer = lab.client.put(lab.session + "/nominal", json={"toml": text}).raise_for_status()
    after = answer.json()["configuration"]
    assert after["parameters"]["fl_integral"]["position_pole_rad_per_s"] == 40.0
    assert (after["gains"], after["actuator"]) == (before["gains"], before["actuator"])
    refused = lab.client.put(lab.session + "/nominal", json={"toml": "[nominal]\nradius_m = 'x'"})
    assert refused.status_code == 422
    assert "radius_m" in refused.json()["detail"]
    refused = lab.client.put(lab.session + "/nominal", json={"toml": "= no TOML"})
    assert "readable TOML" in refused.json()["detail"]
    with run_lab("--parameters", str(path)) as own:
        for state in (own.read(), own.load_figure("5")):
            assert state["configuration"]["nominal"] == configuration["actuator"]
        private = own.client.post("/api/v1/sessions", json={}).json()
        assert private["configuration"]["nominal"] == configuration["actuator"]
        origin = own.client.get(own.session + "/origin").json()
        assert origin["defaults"]["nominal"] == configuration["actuator"]

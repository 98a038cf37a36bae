"""Studies over REST: validated, run, cancelled and continued, displayed, opened as runs."""

import json
import struct

import numpy as np
import pyarrow.parquet as pq
import pytest

from svsa.evaluation.metrics import METRICS
from svsa.evaluation.statistics import estimate_share
from svsa.evaluation.studies.rows import find_missing, read_rows
from svsa.evaluation.studies.store import open_study
from svsa.evaluation.studies.summary import summarize_laws
from svsa_server.jobs.study_rows import thin_out
from tests.lab_in_process import run_lab_in_process
from tests.waiting import follow

STUDIES = "/api/v1/studies"
TEXT = """title = "Short runs"
laws = ["ndobc", "fl"]
runs = 24
seed = 5
duration_s = 1.2
measure_from_s = 0.05

[base]
figure = "4a"
loads = [{ kind = "constant", torque_nm = [0, 0, 0], start_s = 0.1 }]

[[vary]]
path = "loads[0].torque_nm[0]"
kind = "uniform"
low = 0.0
high = 40.0

[[vary]]
path = "effects"
kind = "choice"
values = ["ideal", "rig"]
"""


@pytest.fixture(scope="module")
def lab():
    with run_lab_in_process() as lab:
        yield lab.client


def run_study(lab, **asked):
    begun = lab.post(STUDIES, json={"text": TEXT, **asked})
    assert begun.status_code == 201, begun.text
    return follow(lab, f"{STUDIES}/{begun.json()['name']}", lambda state: not is_under_way(state))


def is_under_way(state):
    return state["job"]["status"] in ("waiting", "running")


@pytest.fixture(scope="module")
def complete_study(lab):
    """The completed study of `TEXT`."""
    return run_study(lab, name="complete_study")


def unpack(content):
    (length,) = struct.unpack_from("<I", content)
    header = json.loads(content[4 : 4 + length])
    assert (4 + length) % 8 == 0
    values = np.frombuffer(content, "<f8", offset=4 + length).reshape(-1, header["rows"])
    return header, {
        one["name"]: column if "labels" not in one else np.array(one["labels"])[column.astype(int)]
        for one, column in zip(header["columns"], values, strict=True)
    }


def test_study_is_run_to_its_end_and_its_rows_are_those_of_the_table(lab, complete_study):
    assert (complete_study["job"]["status"], complete_study["job"]["problem"]) == ("done", None)
    assert (
        complete_study["done"]
        == complete_study["rows"]
        == complete_study["job"]["done"]
        == complete_study["job"]["total"]
        == 48
    )
    listed = lab.get(STUDIES).json()
    assert listed["saved"][0]["name"] == "complete_study"
    assert {"perturbation", "load"} <= {one["name"] for one in listed["built_in"]}

    wanted = ["law", "loads[0].torque_nm[0]", "effects", "peak_position_error_rad", "succeeded"]
    answer = lab.get(f"{STUDIES}/complete_study/rows", params={"column": [*wanted, "fault_tick"]})
    header, columns = unpack(answer.content)
    assert (header["rows"], header["total"]) == (48, 48)
    table = read_rows(open_study("complete_study"))
    assert columns["row"].tolist() == [*range(48)]
    for name in wanted:
        assert columns[name].tolist() == table[name].to_pylist(), name
    ended = [tick is not None for tick in table["fault_tick"].to_pylist()]
    assert np.isfinite(columns["fault_tick"]).tolist() == ended
    assert 0 < sum(ended) < 48
    file = lab.get(f"{STUDIES}/complete_study/rows?format=parquet")
    assert file.content == (open_study("complete_study").folder / "rows.parquet").read_bytes()
    assert file.headers["cache-control"] == "no-cache"


def test_study_with_chosen_metrics_stores_those(lab):
    offered = lab.get(STUDIES).json()["metrics"]
    assert {"name": "effort_n2m2_s", "label": "Control effort", "unit": "N²·m²·s"} in offered
    assert [one["name"] for one in offered] == [*METRICS]
    kept = ["peak_torque1_nm", "limit_share"]
    few = run_study(lab, name="few", runs=4, metrics=kept, success={"limit_share": 0.5})
    assert [one["name"] for one in few["columns"] if one["role"] == "metric"] == kept
    reported = [(one["label"], one["unit"]) for one in few["columns"] if one["role"] == "varied"]
    assert reported == [("Load on the link", "N·m"), ("Effects", "")]
    assert [*lab.get(f"{STUDIES}/few/summary").json()["laws"][0]["quantiles"]] == kept
    row = lab.get(f"{STUDIES}/few/rows/0").json()
    assert {name for name in row if name in METRICS} == {*kept}
    wrong = lab.post(f"{STUDIES}/check", json={"text": 'metrics = ["energy"]\n' + TEXT})
    assert wrong.status_code == 422
    for reported in ("line 1", "metrics[0] is 'energy'", "effort_n2m2_s"):
        assert reported in wrong.json()["detail"]


def test_rows_are_thinned_out_to_the_same_samples_of_every_law(lab, complete_study):
    answer = lab.get(
        f"{STUDIES}/complete_study/rows", params={"column": ["draw", "law"], "most": 11}
    )
    header, columns = unpack(answer.content)
    assert (header["rows"], header["total"]) == (10, 48)
    assert columns["draw"][::2].tolist() == columns["draw"][1::2].tolist()
    assert columns["law"].tolist() == ["ndobc", "fl"] * 5
    rows = read_rows(open_study("complete_study"))
    assert thin_out(rows, 2, 48) is rows
    assert thin_out(rows, 2, 47).num_rows == 46


def test_result_is_summarized_as_by_the_command(lab, complete_study):
    summary = lab.get(f"{STUDIES}/complete_study/summary").json()
    stored = open_study("complete_study")
    for reported, law in zip(
        summary["laws"], summarize_laws(stored.study, read_rows(stored)), strict=True
    ):
        assert (reported["law"], reported["runs"], reported["faults"]) == (
            law.law,
            law.runs,
            law.faults,
        )
        assert reported["success"] == law.success._asdict()
        shown = reported["quantiles"]["peak_position_error_rad"]
        expected = law.quantiles["peak_position_error_rad"]
        assert shown == [value if np.isfinite(value) else None for value in expected]
    (pair,) = summary["pairings"]
    assert (pair["one"], pair["other"], pair["pairs"]) == ("ndobc", "fl", 24)
    refused = lab.get(f"{STUDIES}/complete_study/sensitivity")
    assert refused.status_code == 409
    assert "sampling is sensitivity" in refused.json()["detail"]


def test_row_becomes_a_recorded_run_with_the_metrics_of_the_table(lab, complete_study):
    made = lab.post(f"{STUDIES}/complete_study/rows/7/replay")
    assert made.status_code == 201
    assert made.json()["differing"] == []
    run = lab.get(f"/api/v1/runs/{made.json()['run_id']}").json()
    assert run["name"] == "Study complete_study, row 7"
    row = read_rows(open_study("complete_study")).to_pylist()[7]
    assert (run["fault"]["code"] if run["fault"] else None) == row["fault"]
    reported = lab.get(f"{STUDIES}/complete_study/rows/7").json()
    assert reported == {name: None if one != one else one for name, one in row.items()}
    for wrong in (48, -1):
        assert lab.post(f"{STUDIES}/complete_study/rows/{wrong}/replay").status_code == 422
        assert lab.get(f"{STUDIES}/complete_study/rows/{wrong}").status_code == 422


def test_cancelled_study_keeps_its_rows_and_continues_to_the_same_table(lab, complete_study):
    begun = lab.post(STUDIES, json={"text": TEXT, "name": "left", "runs": 20_000}).json()
    again = reject(lab, {"text": TEXT, "name": "left", "runs": 20_000})
    assert (again.status_code, "cancel it first" in again.json()["detail"]) == (409, True)
    follow(lab, f"{STUDIES}/left", lambda state: state["done"] >= 256)
    lab.delete(f"/api/v1/jobs/{begun['job']['id']}")
    left = follow(lab, f"{STUDIES}/left", lambda state: not is_under_way(state))
    assert left["job"]["status"] == "cancelled"
    assert 256 <= left["done"] < left["rows"] == 40_000
    stored = open_study("left")
    assert find_missing(stored)[0][0] == left["done"] // 2
    first = pq.read_table(stored.folder / "rows.parquet").slice(0, 48)
    assert first.to_pandas().equals(read_rows(open_study("complete_study")).to_pandas())
    on = lab.post(STUDIES, json={"source": "left"}).json()
    assert on["job"]["id"] != begun["job"]["id"]
    follow(
        lab, f"{STUDIES}/left", lambda state: state["done"] > left["done"] or state["job"]["done"]
    )
    lab.delete(f"/api/v1/jobs/{on['job']['id']}")
    follow(lab, f"{STUDIES}/left", lambda state: not is_under_way(state))


def reject(lab, asked):
    """Return the rejection of a study, which its check rejects in the same way."""
    checked, refused = (lab.post(STUDIES + path, json=asked) for path in ("/check", ""))
    assert (checked.status_code, checked.json()) == (refused.status_code, refused.json())
    return refused


def test_study_with_the_name_of_another_one_is_rejected(lab, complete_study):
    refused = reject(lab, {"text": TEXT, "name": "complete_study", "laws": ["pd"]})
    assert refused.status_code == 409
    assert "complete_study is another one" in refused.json()["detail"]
    assert "or delete SVSA_DATA/studies/complete_study." in refused.json()["detail"]


def test_full_queue_of_studies_is_rejected():
    with run_lab_in_process(max_studies="0") as running:
        assert reject(running.client, {"source": "load"}).status_code == 503


def test_invalid_study_is_rejected_with_line_name_value_and_bound(lab):
    wrong = TEXT.replace("high = 40.0", "high = -1.0")
    for path in ("/check", ""):
        refused = lab.post(STUDIES + path, json={"text": wrong, "name": "wrong"})
        assert refused.status_code == 422
        (violation,) = refused.json()["violations"]
        assert (violation["name"], violation["value"]) == ("vary[0].low", 0.0)
        assert "less than high, -1" in violation["bound"]
        assert refused.json()["detail"].startswith("line 15: vary[0].low is 0.0")
    assert lab.get(f"{STUDIES}/wrong").status_code == 404
    for asked, reported in (
        ({}, "source is missing"),
        ({"source": "load", "text": TEXT}, "not both"),
        ({"source": "no_such"}, "a saved study, or one of actuators"),
        ({"source": "../complete_study"}, "a saved study, or one of"),
        ({"text": "title ="}, "a readable TOML file"),
        ({"source": "load", "runs": 10**8}, "at most 10000000 rows"),
        ({"source": "load", "laws": ["no_law"]}, "installed"),
        ({"text": TEXT, "name": "a/b"}, "1 to 64 letters"),
    ):
        refused = reject(lab, asked)
        assert refused.status_code == 422, asked
        assert reported in refused.json()["detail"]
    assert (
        lab.get(f"{STUDIES}/complete_study/rows", params={"column": "no_such"}).status_code == 422
    )


def test_request_overrides_the_values_of_the_file(lab):
    asked = {"source": "load", "runs": 8, "laws": ["pd"], "success": {"recovery_time_s": 0.5}}
    plan = lab.post(f"{STUDIES}/check", json=asked).json()
    assert (plan["name"], plan["laws"], plan["rows"], plan["samples"]) == ("load", ["pd"], 8, 8)
    assert plan["study"]["success"]["recovery_time_s"] == 0.5
    roles = {column["name"]: column["role"] for column in plan["columns"]}
    assert roles["loads[0].torque_nm[0]"] == "varied"
    assert roles["peak_position_error_rad"] == "metric"
    assert not lab.get(f"{STUDIES}/load").is_success


def test_shares_have_the_interval_of_the_library():
    with run_lab_in_process() as lab:
        asked = {"counts": ["8,2", "0,81", "0,0"]}
        found = lab.client.get("/api/v1/shares", params=asked).raise_for_status().json()
        assert tuple(found[0].values()) == estimate_share(8, 10)
        assert tuple(found[1].values()) == estimate_share(0, 81)
        assert found[2] == {"value": None, "low": 0.0, "high": 1.0}
        for counts in (["2"], ["1,1", "1"], ["-1,2"], ["1,1"] * 257):
            answer = lab.client.get("/api/v1/shares", params={"counts": counts})
            assert answer.status_code == 422, answer.text

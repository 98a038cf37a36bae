"""Faults over REST: the table of all kinds, and the fault of a session with its advice."""

from svsa.actuators.faults import FAULTS, advise
from tests.lab import Lab


def test_table_is_that_of_the_library(lab: Lab) -> None:
    rows = lab.client.get("/api/v1/kinds").raise_for_status().json()["faults"]
    assert [row["code"] for row in rows] == list(FAULTS)
    assert rows[0] == {
        "code": "not_finite",
        "number": 1,
        "label": "Not a finite number",
        "cause": FAULTS["not_finite"].cause,
        "advice": FAULTS["not_finite"].advice,
        "where": "both",
        "within_s": 0.002,
    }


def test_fault_of_a_session_has_label_and_advice(lab: Lab) -> None:
    assert lab.read()["fault"] is None
    load = {"kind": "constant", "torque_nm": [40.0, 0.0, 0.0]}
    lab.client.post(lab.session + "/loads", json=load).raise_for_status()
    fault = lab.jump(2.0)["fault"]
    assert fault["code"] == "deflection_limit"
    assert fault["label"] == "Deflection too large"
    assert fault["advice"] == advise(fault["code"], fault["values"])
    assert fault["tick"] > 0
    assert fault["values"]["deflection_rad"]

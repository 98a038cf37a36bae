"""Faults over REST: the table of all kinds, and the fault that a session holds with its advice."""

from svsa.actuators.faults import FAULTS, advise
from tests.lab import Lab


def test_the_table_is_the_library_s(lab: Lab) -> None:
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


def test_a_session_s_fault_has_its_label_and_what_to_try(lab: Lab) -> None:
    assert lab.read()["fault"] is None
    load = {"kind": "constant", "torque_nm": [40.0, 0.0, 0.0]}
    lab.client.post(lab.session + "/loads", json=load).raise_for_status()
    fault = lab.jump(2.0)["fault"]
    assert fault["code"] == "deflection_limit"
    assert fault["label"] == "Deflection too large"
    assert fault["advice"] == advise(fault["code"], fault["values"])
    assert fault["tick"] > 0
    assert fault["values"]["deflection_rad"]

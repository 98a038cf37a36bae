"""Predicted effects of gains and observer over REST, before they are applied."""

import pytest

from tests.lab import Lab


def predict(lab: Lab, **request: dict) -> dict:
    return (
        lab.client.post(lab.session + "/design", json=request | {"kind": "prediction"})
        .raise_for_status()
        .json()
    )


def test_present_design_is_predicted_without_a_change(lab: Lab) -> None:
    lab.load_figure(law="fl")
    before = lab.read()["configuration"]
    found = predict(lab)
    assert found["verdict"] == "ok"
    assert found["stiffness_nm_per_rad"] == pytest.approx(15.0)
    assert found["steady"]["position_error_rad"] == pytest.approx(-0.2107, abs=1e-3)
    assert (found["law"], found["adds_estimate"], found["fl"]) == ("FL", False, None)
    assert found["noise"]["encoders"] == "rig"
    assert found["noise"]["largest_pole"] < 1.0
    assert found["demand"]["peak_torque1_nm"] == pytest.approx(10.45, rel=0.1)
    assert [root["re"] for root in found["stiffness_roots_rad_per_s"]] == [-40, -40]
    assert lab.read()["configuration"] == before


@pytest.mark.parametrize(
    ("request_", "verdict", "code"),
    [
        ({"gains": {"position_poles_rad_per_s": [-90] * 4}}, "refuse", "fault"),
        ({"gains": {"position_poles_rad_per_s": [-60, -60, [5, 30], [5, -30]]}}, "refuse", "gains"),
        ({"observer": {"bandwidth_rad_per_s": [900, 900, 900]}}, "warn", "unstable_loop"),
    ],
)
def test_poor_choice_is_reported_with_its_reason(
    lab: Lab, request_: dict, verdict: str, code: str
) -> None:
    lab.load_figure(law="ndobc")
    found = predict(lab, **request_)
    reasons = {reason["code"]: reason for reason in found["reasons"]}
    assert code in reasons, found
    assert len(reasons[code]["message"]) > 30
    assert found["verdict"] in {verdict, "refuse"}


def test_unstable_gains_are_returned_with_their_roots(lab: Lab) -> None:
    poles = [-60, -60, [5, 30], [5, -30]]
    found = predict(lab, gains={"position_poles_rad_per_s": poles})
    assert max(root["re"] for root in found["position_roots_rad_per_s"]) == pytest.approx(5)
    message = found["reasons"][0]["message"]
    assert message == "Position poles: 5 ± 30j lies right of the imaginary axis."
    assert found["fl"] is found["noise"] is found["demand"] is None


def test_poles_without_a_real_polynomial_are_rejected_by_name(lab: Lab) -> None:
    request = {"gains": {"position_poles_rad_per_s": [-60, -60, -60, [-30, 5]]}}
    answer = lab.client.post(lab.session + "/design", json=request | {"kind": "prediction"})
    assert answer.status_code == 422
    assert answer.json()["violations"][0]["name"] == "position_poles_rad_per_s"


def test_encoders_of_the_session_are_used_if_present(lab: Lab) -> None:
    lab.load_figure()
    effects = {"encoders": {}, "estimation": {}, "delay_samples": 1}
    lab.client.put(lab.session + "/effects", json=effects).raise_for_status()
    assert predict(lab)["noise"]["encoders"] == "session"

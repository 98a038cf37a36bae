"""Stability of a trial design over REST; the session is unchanged."""

import math

import pytest

import svsa
from tests.lab import Lab

UNSTABLE = {"position_poles_rad_per_s": [-60, -60, [5, 30], [5, -30]]}


def ask(lab: Lab, what: str, **request: object) -> dict:
    answer = lab.client.post(f"{lab.session}/design", json={"kind": what, **request})
    return answer.raise_for_status().json()


def test_design_is_returned_with_its_range_without_a_change(lab: Lab) -> None:
    lab.load_figure(law="ndobc")
    before = lab.read()["configuration"]
    found = ask(lab, "stability")
    assert found["slowest_rad_per_s"] == pytest.approx(-20.07, abs=0.05)
    assert found["least_damping"] == pytest.approx(0.41, abs=0.005)
    assert math.degrees(found["ramp_gain_rad_s_per_nm"]) == pytest.approx(0.168, abs=5e-4)
    assert found["fastest_observer_rad_per_s"] == pytest.approx(249.0, rel=0.01)
    inertia = next(one for one in found["ranges"] if one["symbol"] == "M")
    assert inertia["low"] == pytest.approx(0.24, rel=0.05)
    assert found["largest_pole"] < 1.0
    other = ask(lab, "stability", law="fl", stiffness_nm_per_rad=60.0)
    assert (other["law"], other["stiffness_nm_per_rad"]) == ("fl", 60.0)
    assert other["ramp_gain_rad_s_per_nm"] is None
    assert other["fastest_observer_rad_per_s"] is None
    assert lab.read()["configuration"] == before


def test_response_is_that_of_the_trial_poles(lab: Lab) -> None:
    lab.load_figure(law="ndobc")
    present = ask(lab, "response")
    assert math.degrees(present["load"]["peak_error_rad"]) == pytest.approx(4.14, abs=0.05)
    assert present["load"]["fault"] is None
    slower = ask(lab, "response", gains={"position_poles_rad_per_s": [-30] * 4})
    assert slower["load"]["peak_error_rad"] > present["load"]["peak_error_rad"]
    magnitude = slower["disturbance"]["magnitude_rad_per_nm"]
    assert max(magnitude) > max(present["disturbance"]["magnitude_rad_per_nm"])
    assert len(magnitude) == len(slower["disturbance"]["frequency_hz"])


def test_response_reports_an_unstable_loop_on_the_rig(lab: Lab) -> None:
    """β = 400 settles without quantization and delay, where its curves are best; the
    limit is 249.
    """
    lab.load_figure(law="ndobc")
    fast = {"observer": {"bandwidth_rad_per_s": [400.0] * 3}}
    present, found = ask(lab, "response"), ask(lab, "response", **fast)
    assert found["load"]["fault"] is None
    magnitudes = [one["disturbance"]["magnitude_rad_per_nm"] for one in (present, found)]
    assert max(magnitudes[1]) < 0.6 * max(magnitudes[0])
    assert present["encoders"] == found["encoders"] == "rig"
    assert present["largest_pole"] < 1.0 < found["largest_pole"]
    assert found["largest_pole"] == pytest.approx(
        ask(lab, "stability", **fast)["largest_pole"], rel=1e-12
    )


def test_session_with_encoders_is_assessed_by_its_own_loop(lab: Lab) -> None:
    lab.load_figure(law="ndobc")
    rig = svsa.RIG.model_dump(mode="json")
    lab.client.put(f"{lab.session}/effects", json=rig).raise_for_status()
    found = ask(lab, "response", observer={"bandwidth_rad_per_s": [400.0] * 3})
    assert found["encoders"] == "session"
    assert found["disturbance"] is None
    assert found["largest_pole"] > 1.0


def test_poles_in_the_right_half_plane_are_reported_as_unstable(lab: Lab) -> None:
    lab.load_figure(law="ndobc")
    found = ask(lab, "response", gains=UNSTABLE)
    assert found["load"]["fault"]
    assert found["disturbance"] is None
    shown = ask(lab, "stability", gains=UNSTABLE)
    assert shown["slowest_rad_per_s"] > 0.0
    assert shown["ranges"] == []
    assert shown["largest_pole"] > 1.0


def test_zero_gains_are_reported_too(lab: Lab) -> None:
    zero = {"position_coefficients": [0, 0, 0, 0], "stiffness_coefficients": [0, 0]}
    found = ask(lab, "stability", gains=zero, law="ndobc")
    assert found["formula_rad_s_per_nm"] is found["ramp_gain_rad_s_per_nm"] is None
    assert ask(lab, "response", gains=zero)["load"]["time_s"]


def test_map_is_returned_in_parts_from_coarse_to_fine(lab: Lab) -> None:
    lab.load_figure(law="ndobc")
    first = ask(lab, "region", starts=5, count=9)
    assert len(first["positions_rad"]) == 5
    assert {(one["row"], one["column"]) for one in first["outcomes"]} == {
        (row, column) for row in (0, 2, 4) for column in (0, 2, 4)
    }
    middle = next(one for one in first["outcomes"] if (one["row"], one["column"]) == (2, 2))
    assert middle["outcome"] == "rest"
    rest = ask(lab, "region", starts=5, first=first["next"], count=100)
    assert rest["next"] is None
    assert len(first["outcomes"]) + len(rest["outcomes"]) == 25
    stiff = ask(lab, "region", starts=5, count=25, stiffness_nm_per_rad=60.0)
    assert sum(one["outcome"] == "rest" for one in stiff["outcomes"]) > 20


def test_other_slice_has_starts_with_a_deflection(lab: Lab) -> None:
    lab.load_figure(law="ndobc")
    slower = {"gains": {"position_poles_rad_per_s": [-45] * 4}, "starts": 7, "count": 49}
    shares = [
        sum(
            one["outcome"] == "rest"
            for one in ask(lab, "region", chosen=chosen, **slower)["outcomes"]
        )
        for chosen in ("rigid", "deflected")
    ]
    assert shares[0] == 49
    assert shares[1] < 40


@pytest.mark.parametrize("law", ["ndobc", "ndobc_w"])
def test_every_law_has_margins_including_those_without_a_continuous_model(
    lab: Lab, law: str
) -> None:
    lab.load_figure(law=law)
    found = ask(lab, "margins")
    assert (found["law"], found["encoders"], found["is_stable"]) == (law, "rig", True)
    assert 0.2 < found["modulus"] < 0.5
    assert 0.0015 < found["delay_s"] < 0.003
    assert found["torque1_gain"]["low"] < 1.0 < found["torque1_gain"]["high"]
    errors = found["joint_errors"]
    assert math.hypot(*errors.values()) == pytest.approx(found["joint_error"])
    assert set(errors) == {"M", "B1", "B2", "Ks"}


def test_unstable_design_faults_in_a_private_simulation_only(lab: Lab) -> None:
    lab.load_figure(law="ndobc")
    before = lab.read()["configuration"]
    opening = {"from": "session", "id": "lab", "gains": UNSTABLE}
    private = lab.client.post("/api/v1/sessions", json=opening).raise_for_status().json()
    assert private["session"] != lab.read()["session"]
    roots = private["configuration"]["gains"]["position_roots_rad_per_s"]
    assert max(root["re"] for root in roots) == pytest.approx(5.0)
    path = f"/api/v1/sessions/{private['session']}"
    lab.client.post(f"{path}/pause").raise_for_status()
    lab.client.post(f"{path}/reset").raise_for_status()
    failed = lab.client.post(f"{path}/step", json={"ticks": 5000}).raise_for_status().json()
    assert failed["status"] == "fault"
    assert failed["fault"]["message"]
    lab.client.post(f"{path}/reset").raise_for_status()
    refused = lab.client.post(f"{path}/recording", json={"name": "it fails"})
    assert refused.status_code == 422
    assert "lies right of" in refused.json()["detail"]
    lab.client.delete(path).raise_for_status()
    assert lab.read()["configuration"] == before
    assert lab.client.put(f"{lab.session}/gains", json=UNSTABLE).status_code == 422


@pytest.mark.parametrize(
    ("request_", "said"),
    [
        ({"stiffness_nm_per_rad": 500.0}, "500"),
        ({"gains": {"position_poles_rad_per_s": [-60, -60, -60, [5, 30]]}}, "conjugate"),
        ({"gains": {"position_coefficients": [1.6e29, 3.2e22, 2.4e15, 8e7]}}, "faster than 1000"),
        ({"law": "none_such"}, "none_such"),
    ],
)
def test_invalid_design_is_rejected(lab: Lab, request_: dict, said: str) -> None:
    answer = lab.client.post(f"{lab.session}/design", json=request_ | {"kind": "response"})
    assert answer.status_code == 422
    assert said in answer.json()["detail"]

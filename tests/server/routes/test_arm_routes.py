"""An arm over REST: settings of each joint, loads at the tip, a second arm, records, errors."""

import pytest
from httpx import Response

from svsa.runs.records.catalogue.runs import Catalogue
from svsa.runs.records.resimulation import compare_with_simulation
from tests.lab import Lab
from tests.waiting import follow_recording

SESSIONS = "/api/v1/sessions"
ELLIPSE = {
    "kind": "ellipse",
    "center_m": [0.25, -0.35],
    "radii_m": [0.1, 0.05],
    "frequency_hz": 0.25,
}
TIP_MASS = {"kind": "tip_mass", "mass_kg": 0.1}


@pytest.fixture
def path(lab: Lab) -> str:
    """The address of a paused session of an arm with the SVSA in both joints, at tick 0."""
    state = open_arm(lab)
    address = f"{SESSIONS}/{state['session']}"
    lab.client.post(f"{address}/pause")
    lab.client.post(f"{address}/reset")
    return address


def open_arm(lab: Lab, **wanted: object) -> dict:
    answer = lab.client.post(SESSIONS, json={"from": "arm", **wanted})
    assert answer.status_code == 201, answer.text
    return answer.json()


@pytest.mark.exhaustive
def test_every_arm_of_the_list_opens_with_its_actuators(lab: Lab) -> None:
    listed = lab.client.get("/api/v1/arms").json()
    assert [arm["name"] for arm in listed] == ["rods", "maccepa", "chain"]
    for named in listed:
        state = open_arm(lab, arm=named["name"])
        arm = state["configuration"]["arm"]
        assert arm["links"] == arm["model"] == named["links"]
        actuators = (state["actuator"], *state["other_actuators"])
        assert {actuator["name"] for actuator in actuators} == {named["actuator"]}
        numbers = range(1, len(named["links"]["chain"]) + 1)
        assert [lane["joint"] for lane in state["lanes"]] == list(numbers)
    mixed = open_arm(lab, actuators=["svsa", "qbmove"], feedforward=True)
    assert mixed["other_actuators"][0]["name"] == "qbmove"
    assert mixed["configuration"]["arm"]["feedforward"] is True


@pytest.mark.exhaustive
def test_arm_of_three_joints_is_changed_joint_by_joint_and_recorded(lab: Lab) -> None:
    own = f"{SESSIONS}/{open_arm(lab, arm='chain', actuators=['svsa'] * 3)['session']}"
    lab.client.post(f"{own}/pause")
    lab.client.post(f"{own}/reset")
    lab.client.post(f"{own}/recording", json={"name": "Three joints"})
    lab.client.put(f"{own}/law?joint=3", json={"law": "fl"})
    torque = {"kind": "constant", "torque_nm": [0.1, 0.0, 0.0]}
    lab.client.post(f"{own}/loads?joint=3", json=torque)
    state = lab.client.post(f"{own}/step", json={"ticks": 300}).json()
    assert [lane["law"] for lane in state["lanes"]] == ["ndobc", "ndobc", "fl"]
    assert [held["joint"] for held in state["loads"]] == [3]
    refused = lab.client.put(f"{own}/law?joint=4", json={"law": "fl"})
    assert refused.status_code == 409
    assert "joints are 1 to 3" in refused.json()["detail"]
    run_id = state["recording"]["run_id"]
    lab.client.delete(f"{own}/recording")
    follow_recording(lab.client, f"/api/v1/runs/{run_id}")
    assert compare_with_simulation(Catalogue().open(run_id)).identical
    replay = lab.client.get(f"/api/v1/runs/{run_id}/replay")
    assert replay.status_code == 200
    assert "Joint 3" in replay.text


def test_setting_of_a_joint_leaves_the_other_one(lab: Lab, path: str) -> None:
    lab.client.put(f"{path}/law?joint=2", json={"law": "fl"})
    soft = {"kind": "constant", "stiffness_nm_per_rad": 40.0}
    lab.client.put(f"{path}/stiffness?joint=1", json=soft)
    inertia = {"link_inertia_kg_m2": 0.05}
    state = lab.client.patch(f"{path}/nominal?joint=2", json=inertia).json()
    first, second = state["configuration"], state["configuration"]["arm"]["other_joints"][0]
    assert (first["law"], second["law"]) == ("ndobc", "fl")
    assert (first["stiffness"], second["stiffness"]["stiffness_nm_per_rad"]) == (
        first["stiffness"] | soft,
        80.0,
    )
    assert second["nominal"]["link_inertia_kg_m2"] == 0.05
    assert first["nominal"]["link_inertia_kg_m2"] != 0.05


def test_patch_of_both_joints_keeps_what_differs_between_them(lab: Lab, path: str) -> None:
    before = lab.client.get(path).json()["configuration"]
    damping = {"link_damping_nms_per_rad": 0.02}
    after = lab.client.patch(f"{path}/nominal", json=damping).json()["configuration"]
    others = (of["arm"]["other_joints"][0] for of in (before, after))
    for old, new in ((before, after), tuple(others)):
        assert new["nominal"] == old["nominal"] | damping


@pytest.mark.exhaustive
def test_value_that_one_joint_rejects_changes_neither(lab: Lab) -> None:
    state = open_arm(lab, actuators=["svsa", "qbmove"])
    path = f"{SESSIONS}/{state['session']}"
    hard = {"kind": "constant", "stiffness_nm_per_rad": 100.0}
    refused = lab.client.put(f"{path}/stiffness", json=hard)
    assert refused.status_code == 422
    assert "100" in refused.json()["detail"]
    assert (
        lab.client.get(path).json()["configuration"]["stiffness"]
        == (state["configuration"]["stiffness"])
    )


def test_second_arm_has_the_loads_at_the_tip(lab: Lab, path: str) -> None:
    lab.client.post(f"{path}/step", json={"ticks": 100})
    state = lab.client.put(f"{path}/lanes", json={"comparisons": [{"law": "fl"}]}).json()
    assert [lane["name"] for lane in state["lanes"]] == [
        "Joint 1 NDOBC",
        "Joint 2 NDOBC",
        "Joint 1 FL",
        "Joint 2 FL",
    ]
    styles = [lane["segments"][-1]["line_style"] for lane in state["lanes"]]
    assert styles[0] == styles[1] != styles[2] == styles[3]
    hung = lab.client.post(f"{path}/loads", json=TIP_MASS).json()
    assert hung["label"] == "0.1 kg at the tip"
    state = lab.client.post(f"{path}/step", json={"ticks": 4000}).json()
    ndobc, _, fl, _ = (lane["since_load"]["rms_position_error_rad"] for lane in state["lanes"])
    assert ndobc < 0.3 * fl
    refused = lab.client.put(f"{path}/lanes", json={"comparisons": [{"law": "fl"}] * 2})
    assert refused.status_code == 422


def test_feedforward_and_adaptation_act_at_once(lab: Lab, path: str) -> None:
    lab.client.post(f"{path}/step", json={"ticks": 100})
    assert lab.client.get(path).json()["payload_kg"] is None
    state = lab.client.patch(f"{path}/arm", json={"feedforward": True, "adaptation": {}}).json()
    assert state["tick"] == 100
    assert {event["label"] for event in state["events"]} == {
        "Arm feedforward changed",
        "Adaptive payload changed",
    }
    lab.client.post(f"{path}/loads", json=TIP_MASS)
    state = lab.client.post(f"{path}/step", json={"ticks": 6000}).json()
    assert state["payload_kg"] == [pytest.approx(0.1, abs=0.02)]


def test_reference_of_the_tip_restarts_the_run(lab: Lab, path: str) -> None:
    lab.client.put(f"{path}/law?joint=2", json={"law": "fl"})
    lab.client.post(f"{path}/step", json={"ticks": 100})
    state = lab.client.patch(f"{path}/arm", json={"tip": ELLIPSE}).json()
    assert state["tick"] == 0
    assert state["configuration"]["arm"]["other_joints"][0]["law"] == "fl"
    refused = lab.client.put(f"{path}/position", json={"kind": "constant", "position_rad": 0.1})
    assert refused.status_code == 422
    assert "reference of the tip" in refused.json()["detail"]
    far = lab.client.patch(f"{path}/arm", json={"tip": {**ELLIPSE, "radii_m": [0.9, 0.05]}})
    assert far.status_code == 422
    assert "away from joint 1" in far.json()["detail"]
    state = lab.client.patch(f"{path}/arm", json={"tip": None}).json()
    assert state["configuration"]["arm"]["tip"] is None


def test_load_names_the_joint_on_which_it_acts(lab: Lab, path: str) -> None:
    torque = {"kind": "constant", "torque_nm": [0.5, 0, 0]}
    for query, load in (("", torque), ("?joint=2", torque), ("", TIP_MASS)):
        lab.client.post(f"{path}/loads{query}", json=load).raise_for_status()
    assert [one["joint"] for one in lab.client.get(f"{path}/loads").json()] == [1, 2, None]


def test_pushes_at_the_tip_are_one_load(lab: Lab, path: str) -> None:
    for x in (1.0, 2.0, 3.0):
        push = {"kind": "tip_push", "force_n": [x, 0.0], "hold_s": 0.3}
        assert lab.client.post(f"{path}/loads", json=push).status_code == 201
        lab.client.post(f"{path}/step", json={"ticks": 50})
    (load,) = lab.client.get(f"{path}/loads").json()
    assert load["load"]["force_n"] == [3.0, 0.0]


def test_recorded_session_is_simulated_again_and_branched(lab: Lab, path: str) -> None:
    lab.client.post(f"{path}/recording", json={"name": "Arm"})
    lab.client.post(f"{path}/step", json={"ticks": 200})
    lab.client.put(f"{path}/law?joint=2", json={"law": "fl"})
    lab.client.post(f"{path}/loads", json={"kind": "tip_mass", "mass_kg": 0.05})
    lab.client.post(f"{path}/step", json={"ticks": 300})
    run_id = lab.client.get(path).json()["recording"]["run_id"]
    lab.client.delete(f"{path}/recording")
    entry = follow_recording(lab.client, f"/api/v1/runs/{run_id}")
    assert entry["settings"]["name"].startswith("Arm")
    record = Catalogue().open(run_id)
    assert compare_with_simulation(record).identical
    found = lab.client.get(f"/api/v1/runs/{run_id}").json()
    assert len(found["lanes"]) == 2
    branch = lab.client.post(SESSIONS, json={"from": "run", "id": run_id, "tick": 400}).json()
    assert branch["tick"] == 400
    assert branch["configuration"]["arm"]["other_joints"][0]["law"] == "fl"


@pytest.mark.parametrize(
    ("wanted", "detail"),
    [
        ({"arm": "rod"}, "rods"),
        ({"actuators": ["svsa", "qbmov"]}, "qbmove"),
        ({"tip": {**ELLIPSE, "center_m": [5.0, 0.0]}}, "away from joint 1"),
        ({"law": "ndobc_s", "feedforward": True}, "takes the arm feedforward"),
    ],
)
def test_arm_that_cannot_be_opened_is_explained(lab: Lab, wanted: dict, detail: str) -> None:
    refused = lab.client.post(SESSIONS, json={"from": "arm", **wanted})
    assert refused.status_code == 422
    assert detail in refused.json()["detail"]


def test_single_joint_has_no_arm(lab: Lab) -> None:
    refused = lab.client.patch(f"{SESSIONS}/lab/arm", json={"feedforward": True})
    assert refused.status_code == 409
    assert "single joint" in refused.json()["detail"]
    load = {"kind": "tip_mass", "mass_kg": 0.1}
    assert lab.client.post(f"{SESSIONS}/lab/loads", json=load).status_code == 409
    assert lab.client.put(f"{SESSIONS}/lab/law?joint=2", json={"law": "fl"}).status_code == 409


def test_figures_and_excitation_are_of_a_single_joint(lab: Lab, path: str) -> None:
    assert lab.client.post(f"{path}/experiment", json={"figure": "4a"}).status_code == 409
    excitation = lab.client.post(f"{path}/excitation", json={})
    assert excitation.status_code == 409
    assert "single joint" in excitation.json()["detail"]


def test_design_of_one_joint_is_analyzed_alone(lab: Lab, path: str) -> None:
    stiffness = {"kind": "constant", "stiffness_nm_per_rad": 33.0}
    assert lab.client.put(f"{path}/stiffness?joint=2&restart=true", json=stiffness).is_success

    def analyze(joint: int | None) -> Response:
        request = {"kind": "prediction"} | ({} if joint is None else {"joint": joint})
        return lab.client.post(f"{path}/design", json=request)

    first, second = (analyze(joint).json()["stiffness_nm_per_rad"] for joint in (1, 2))
    assert first == analyze(None).json()["stiffness_nm_per_rad"] != second
    assert second == pytest.approx(33.0, rel=0.05)
    assert analyze(3).status_code == 409

"""Settings over REST, and the rejection of invalid values."""

import pytest

from tests.lab import Lab

ACCEPTED = [
    ("PUT", "position", {"kind": "constant", "position_rad": 0.5}, "position", "position_rad"),
    (
        "PUT",
        "position",
        {"kind": "sine", "amplitude_rad": 0.3, "frequency_hz": 0.5, "transition_s": 2},
        "position",
        "frequency_hz",
    ),
    (
        "PUT",
        "stiffness",
        {"kind": "constant", "stiffness_nm_per_rad": 60},
        "stiffness",
        "stiffness_nm_per_rad",
    ),
    ("PUT", "observer", {"bandwidth_rad_per_s": [80, 90, 100]}, "observer", "bandwidth_rad_per_s"),
    ("PATCH", "actuator", {"link_inertia_kg_m2": 0.02}, "actuator", "link_inertia_kg_m2"),
    (
        "PATCH",
        "nominal",
        {"motor1_damping_nms_per_rad": 0.01},
        "nominal",
        "motor1_damping_nms_per_rad",
    ),
]


@pytest.mark.parametrize(("method", "path", "body", "section", "field"), ACCEPTED)
def test_setting_is_applied(
    lab: Lab, method: str, path: str, body: dict, section: str, field: str
) -> None:
    state = lab.client.request(method, f"{lab.session}/{path}", json=body).raise_for_status().json()
    assert state["configuration"][section][field] == body[field]
    assert lab.read()["configuration"][section][field] == body[field]


def test_gains_are_set_as_poles_or_as_coefficients(lab: Lab) -> None:
    poles = {"position_poles_rad_per_s": [-50, -50, [-30, 20], [-30, -20]]}
    gains = lab.client.put(lab.session + "/gains", json=poles).json()["configuration"]["gains"]
    c0, _, _, c3 = gains["position_coefficients"]
    assert c0 == pytest.approx(50 * 50 * (30**2 + 20**2))
    assert c3 == pytest.approx(160)
    assert gains["stiffness_coefficients"] == [1600, 80]
    body = {"stiffness_coefficients": [900, 60]}
    gains = lab.client.put(lab.session + "/gains", json=body).json()["configuration"]["gains"]
    assert [root["re"] for root in gains["stiffness_roots_rad_per_s"]] == pytest.approx([-30, -30])


SINE = {"kind": "sine", "amplitude_rad": 1, "frequency_hz": 0.2}
REFUSED = [
    ("PUT", "position", SINE | {"frequency_hz": 9}, "frequency_hz", "Hz", "at most 5 Hz"),
    ("PUT", "position", SINE | {"amplitude_rad": "60"}, "amplitude_rad", "rad", "a number"),
    ("PUT", "position", SINE | {"amplitude_rad": True}, "amplitude_rad", "rad", "a number"),
    ("PUT", "position", SINE | {"speed": 1}, "speed", "", "unknown field"),
    ("PUT", "position", {"kind": "square"}, "kind", "", "'chirp', 'constant'"),
    ("PUT", "position", {"kind": "sine", "frequency_hz": 1}, "amplitude_rad", "rad", "given"),
    (
        "PUT",
        "stiffness",
        {"kind": "constant", "stiffness_nm_per_rad": 151},
        "stiffness",
        "N·m/rad",
        "from 1.7 to 150.56 N·m/rad",
    ),
    (
        "PUT",
        "stiffness",
        {"kind": "sine", "offset_nm_per_rad": 10, "amplitude_nm_per_rad": 9, "frequency_hz": 1},
        "stiffness",
        "N·m/rad",
        "from 1.7 to",
    ),
    ("PUT", "law", {"law": "no_law"}, "law", "", "installed here: ndobc, "),
    ("PUT", "gains", {}, "gains", "", "poles or coefficients"),
    (
        "PUT",
        "gains",
        {"position_coefficients": [1, 1, 1, 1]},
        "position_coefficients",
        "",
        "the roots are 0.309",
    ),
    (
        "PUT",
        "gains",
        {"stiffness_poles_rad_per_s": [[-1, 2], [-1, 2]]},
        "stiffness_poles_rad_per_s",
        "rad/s",
        "conjugate",
    ),
    (
        "PUT",
        "observer",
        {"bandwidth_rad_per_s": [60, 60, 5000]},
        "bandwidth_rad_per_s[2]",
        "rad/s",
        "at most 1000 rad/s",
    ),
    (
        "PUT",
        "observer",
        {"bandwidth_rad_per_s": [60, 60]},
        "bandwidth_rad_per_s[2]",
        "rad/s",
        "given",
    ),
    ("PATCH", "actuator", {"radius_m": 0}, "actuator.radius_m", "m", "at least 0.001 m"),
    ("PATCH", "nominal", {"radius_m": 0}, "nominal.radius_m", "m", "at least 0.001 m"),
    ("PATCH", "nominal", {"radius_m": None}, "nominal.radius_m", "m", "a number, at least 0.001 m"),
    ("PATCH", "nominal", {"mass": 1}, "nominal.mass", "", "unknown field"),
    (
        "PUT",
        "lanes",
        {"comparisons": [{"law": "fl"}, {"law": "no_law"}]},
        "comparisons[1].law",
        "",
        "installed here: ndobc, ",
    ),
    (
        "PUT",
        "effects",
        {"noise": {"motor_std_rad": -1}},
        "noise.motor_std_rad",
        "rad",
        "at least 0 rad",
    ),
    ("PUT", "speed", {"speed": 1e9}, "speed", "1", "at most 20"),
    (
        "PUT",
        "gains",
        {"position_poles_rad_per_s": [24.4, -60, -40, -40]},
        "position_poles_rad_per_s",
        "rad/s",
        "left of the imaginary axis",
    ),
    (
        "POST",
        "loads",
        {"kind": "series", "time_s": [0, 1], "torque_nm": [[99, 0, 0], [0, 0, 0]]},
        "torque_nm[0][0]",
        "N·m",
        "at most 50 N·m",
    ),
    ("POST", "step", {"ticks": 1.5}, "ticks", "ticks", "an integer"),
    ("POST", "experiment", {"figure": "9"}, "figure", "", "'4a', '4b' or '5'"),
    ("POST", "loads", {"kind": "mass", "mass_kg": -3}, "mass_kg", "kg", "greater than 0 kg"),
    (
        "POST",
        "loads",
        {"kind": "series", "time_s": [0, 0], "torque_nm": [[0, 0, 0], [0, 0, 0]]},
        "time_s",
        "s",
        "increasing",
    ),
]


@pytest.mark.parametrize(("method", "path", "body", "name", "unit", "bound"), REFUSED)
def test_invalid_input_names_field_unit_and_bound_and_changes_nothing(
    lab: Lab, method: str, path: str, body: dict, name: str, unit: str, bound: str
) -> None:
    lab.client.post(lab.session + "/pause")
    before = lab.read()
    answer = lab.client.request(method, f"{lab.session}/{path}", json=body)
    assert answer.status_code == 422
    (violation,) = answer.json()["violations"]
    assert violation["name"] == name
    assert violation["unit"] == unit
    assert bound in violation["bound"]
    assert name in answer.json()["detail"]
    assert lab.read() == before


def test_too_many_loads_and_too_many_fades_are_reported(lab: Lab) -> None:
    lab.client.post(lab.session + "/pause")
    answers = [lab.client.post(lab.session + "/loads", json={"kind": "paper"}) for _ in range(17)]
    assert [answer.status_code for answer in answers[-2:]] == [201, 409]
    body = {"kind": "constant", "position_rad": 0.1, "transition_s": 60}
    lab.client.put(lab.session + "/position", json=body).raise_for_status()
    codes = [
        lab.client.put(lab.session + "/position?restart=true", json=body).status_code
        for _ in range(32)
    ]
    assert codes[0] == 200
    assert codes[-1] == 409


def test_load_error_recovers_with_ndobc_and_remains_with_fl(lab: Lab) -> None:
    peaks = {}
    for law in ("ndobc", "fl"):
        lab.load_figure("4a", law)
        lab.jump(2)
        lab.client.post(lab.session + "/loads", json={"kind": "paper"})
        state = lab.jump(3)
        peaks[law] = state["lanes"][0]["since_load"]
        assert state["events"][-1]["label"] == "3 kg load on"
        assert abs(state["sample"]["estimate_link_nm"] - 2.0) < 0.1
        error = abs(state["sample"]["position_error_rad"])
        assert error < 1e-3 if law == "ndobc" else error > 0.1
        lab.client.delete(lab.session + "/loads")
        assert lab.read()["events"][-1]["kind"] == "load_off"
    assert peaks["ndobc"]["recovery_time_s"] < 0.5
    assert peaks["fl"]["recovery_time_s"] is None

"""Runs of an arm: known answers of the prototype, feedforward, what a joint cannot be."""

import math
from dataclasses import replace

import numpy as np
import pytest

import svsa
from svsa.actuators.arm.dynamics import compute_mass_matrix, turn
from svsa.actuators.arm.parameters import RODS, build_rods
from svsa.actuators.signals import CHANNELS
from svsa.control.installed import get_law, list_law_names
from svsa.runs.definition.arm_experiment import build_actuated_arm, build_arm_experiment
from svsa.runs.execution.arm_run import ArmRun

LOAD = svsa.TipMass(mass_kg=0.1, start_s=5.0)
BEFORE_S, AFTER_S = (2.0, 5.0), (8.0, 20.0)
PUSH = svsa.ConstantLoad(torque_nm=(1.0, 0.0, 0.0))
ELLIPSE = svsa.TipEllipse(center_m=(0.1, -0.4), radii_m=(0.1, 0.05), frequency_hz=0.5)
SOFT = {"stiffness_nm_per_rad": 100.0}
HEAVY = RODS.change_link(1, length_m=3.0).change_link(2, mass_kg=50.0)
LIGHT = build_rods((0.2, 0.2), (0.2, 0.2))
"""An arm that all laws but two carry with the parameters tuned for a single joint."""
KNOWN = {
    ("fl", False): (1.49, 1.98, 1.95, 2.97),
    ("ndobc", False): (0.070, 0.102, 0.100, 0.189),
    ("fl", True): (0.003, 0.015, 0.50, 1.15),
}
"""The prototype: rms of q1 and q2 before and after the load, degrees."""


def measure_deg(result, *windows):
    return tuple(math.degrees(rms) for window in windows for rms in result.measure(*window))


@pytest.mark.parametrize(("law", "feedforward"), KNOWN)
def test_tracking_errors_match_the_prototype(law, feedforward):
    """All given digits: three, or those that a thousandth of a degree has."""
    result = svsa.simulate_arm(law=law, feedforward=feedforward, tip_loads=[LOAD])
    known = KNOWN[law, feedforward]
    for measured, value in zip(measure_deg(result, BEFORE_S, AFTER_S), known, strict=True):
        assert measured == pytest.approx(value, abs=0.0051 if value >= 0.3 else 0.00051)


def test_feedforward_in_the_observer_lowers_the_error_before_and_after_the_load():
    """The prototype's observer did not: 0.041 and 0.048 before, 0.072 and 0.133 after."""
    result = svsa.simulate_arm(law="ndobc", feedforward=True, tip_loads=[LOAD])
    before, after = measure_deg(result, BEFORE_S), measure_deg(result, AFTER_S)
    fl = svsa.simulate_arm(law="fl", feedforward=True, tip_loads=[LOAD])
    assert np.all(np.array(before) < 0.1 * np.array(measure_deg(fl, BEFORE_S)))
    assert after[0] < 0.05 and after[1] < 0.1


def test_feedforward_with_exact_models_leaves_no_error():
    """Nominal motors, dampings and arm as they are: what is left is the sampling."""
    plant = build_arm_experiment("rods", {}, {}).actuator
    names = [name for name in type(plant).model_fields if not name.startswith("link_inertia")]
    exact = {name: getattr(plant, name) for name in names}
    result = svsa.simulate_arm(law="fl", feedforward=True, nominal=exact, duration_s=6.0)
    assert max(measure_deg(result, (2.0, 6.0))) < 5e-4
    wrong = RODS.change_link(2, mass_kg=0.36)
    worse = svsa.simulate_arm(
        law="fl", feedforward=True, nominal=exact, model=wrong, duration_s=6.0
    )
    assert min(measure_deg(worse, (2.0, 6.0))) > 0.1


def measure_both(law):
    """The errors without and with feedforward, degrees."""
    options = {"law": law, "arm": LIGHT, "stiffness": 60.0, "duration_s": 5.0}
    runs = [svsa.simulate_arm(**options, feedforward=feedforward) for feedforward in (False, True)]
    return [measure_deg(run, (2.0, 5.0)) for run in runs]


@pytest.mark.parametrize("law", list_law_names())
def test_feedforward_lowers_the_error_of_every_law_that_takes_it(law):
    if get_law(law).takes_feedforward:
        plain, fed = measure_both(law)
        assert fed[0] < 0.1 * plain[0] and fed[1] < 0.1 * plain[1], (plain, fed)
        return
    with pytest.raises(svsa.ParameterError, match=rf"^law is '{law}'.*count twice"):
        svsa.simulate_arm(law=law, feedforward=True)


@pytest.mark.parametrize("law", ["adrc", "super_twisting", "esp", "linear_dob"])
def test_feedforward_would_raise_the_error_of_laws_that_reject_it(law, monkeypatch):
    taking = replace(get_law(law), rejects_feedforward=False, estimate="none")
    monkeypatch.setattr("svsa.runs.definition.configuration.get_law", lambda name: taking)
    plain, fed = measure_both(law)
    assert fed[0] > 1.5 * plain[0] and fed[1] > 1.5 * plain[1], (plain, fed)


def test_joint_2_of_an_arm_that_joint_1_cannot_move_is_a_single_joint():
    """Link 1 of 9.9 kg·m²: joint 2 alone, under the same pulse, law and encoders.

    About q = 0 its inertia is M22 − M12²/M11, because link 1 moves a little in the opposite
    direction.
    """
    arm = RODS.change_link(1, inertia_kg_m2=9.9).changed(gravity_m_per_s2=0.0)
    M = compute_mass_matrix(arm.build(), turn((0.0, 0.0)))
    pulse = svsa.PulseLoad(torque_nm=(1.0, 0.0, 0.0), start_s=0.5, duration_s=0.4)
    settings = {"position": 0.0, "stiffness": 40.0, "duration_s": 2.0}
    of_joint = {"loads": pulse, "effects": "rig", "nominal": {"link_inertia_kg_m2": 0.0117}}
    of_arm = svsa.simulate_arm(arm=arm, joint2=of_joint, **settings).joints[1]
    inertia = {"link_inertia_kg_m2": M[1][1] - M[0][1] ** 2 / M[0][0]}
    alone = svsa.simulate("4a", "ndobc", actuator=inertia, **of_joint, **settings)
    assert np.abs(alone.position_rad).max() > 0.03
    assert of_arm.position_rad == pytest.approx(alone.position_rad, abs=5e-4)
    assert of_arm.stiffness_nm_per_rad == pytest.approx(alone.stiffness_nm_per_rad, abs=0.01)


def test_comparison_has_the_laws_of_the_second_arm():
    result = svsa.simulate_arm(law="ndobc", comparisons=["fl"], duration_s=0.05)
    (second,) = result.comparisons
    assert [joint.law for joint in (*result.joints, *second.joints)] == ["ndobc"] * 2 + ["fl"] * 2
    assert repr(result).startswith("Arm: NDOBC, ")
    assert repr(second).startswith("Arm: FL, ")


def test_joints_list_their_changes_of_the_law():
    change = svsa.Change(at_s=0.02, joint=2, law="fl")
    options = {"law": "ndobc", "comparisons": ["pd"], "duration_s": 0.05}
    result = svsa.simulate_arm(**options, commands=[change])
    (second,) = result.comparisons
    found = [
        [(law, rows.start) for law, rows in joint.list_segments()]
        for joint in (*result.joints, *second.joints)
    ]
    assert found == [[("ndobc", 0)], [("ndobc", 0), ("fl", 20)], [("pd", 0)], [("pd", 0)]]


def test_change_of_the_feedforward_of_one_joint_is_rejected():
    with pytest.raises(svsa.ParameterError, match="feedforward, which acts on all joints"):
        svsa.Change(at_s=0.02, joint=2, feedforward=True)


def test_run_in_several_calls_equals_one_call_bit_for_bit():
    """With every effect on, two laws, and loads on joints and tip that begin between the pieces."""
    c = build_arm_experiment(
        "rods",
        {},
        {"effects": svsa.RIG},
        ({"law": "fl"}, {"loads": svsa.SineLoad(torque_nm=(0.2, 0.0, 0.0), frequency_hz=3.0)}),
        (LOAD.changed(start_s=0.15), svsa.TipForce(force_n=(1.0, 0.0))),
    )
    whole, pieces = np.empty((2, 2, 300, len(CHANNELS)))
    assert ArmRun(c).advance(whole) == 300
    run = ArmRun(c)
    for begin, stop in ((0, 1), (1, 140), (140, 300)):
        assert run.advance(pieces[:, begin:stop]) == stop - begin
    assert whole.tobytes() == pieces.tobytes()


def test_tip_position_and_stiffness_follow_from_the_joints():
    """A small force at the tip of the arm at rest moves it by K⁻¹ f, with FL's stiff positions."""
    still = {"joint1": {"position": 0.4}, "joint2": {"position": 0.9}, "duration_s": 0.1}
    result = svsa.simulate_arm("rods", "fl", **still)
    q, tip = result.samples[:, 0, 4], result.tip_position_m[0]
    assert q == pytest.approx([0.4, 0.9])
    assert tip == pytest.approx(
        [0.3 * math.sin(0.4) + 0.3 * math.sin(1.3), -0.3 * math.cos(0.4) - 0.3 * math.cos(1.3)]
    )
    K, h = result.tip_stiffness_n_per_m[0], 1e-6
    columns = [
        (place(0.4 + h * (i == 0), 0.9 + h * (i == 1)) - place(0.4, 0.9)) / h for i in (0, 1)
    ]
    jacobian = np.stack(columns, 1)
    assert jacobian.T @ K @ jacobian == pytest.approx(np.diag([80.0, 80.0]), abs=1e-2)


def place(q1, q2):
    return 0.3 * np.array([math.sin(q1) + math.sin(q1 + q2), -math.cos(q1) - math.cos(q1 + q2)])


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"comparisons": ["fl", "pd"]}, "comparisons is 2: it must be at most 1"),
        ({"effects": {"gravity": {"moment_nm": 0.5}}}, "effects.gravity"),
        ({"loads": svsa.MassLoad()}, "loads is 'mass'.*tip_mass"),
        ({"joint2": {"loads": LOAD}}, "joint2.loads"),
        ({"joint2": {"sampling": {"period_s": 0.002}}}, "joint2.sampling.period_s is 0.002"),
        ({"joint2": {"law": "nothing"}}, "joint2.law"),
        ({"experiment": "rod"}, "there is no such arm.*rods"),
        ({"experiment": None}, "there is no such arm.*rods"),
        ({"stifness": 3.0}, "stifness"),
        ({"steps": 1.5}, "steps is 1.5: it must be an integer"),
        ({"arm": {"length1_m": 0.3}}, "arm is .*: it must be svsa.ArmParameters"),
        ({"arm": HEAVY}, "about joint 1 is 451.*to 10 kg"),
        ({"tip_loads": [PUSH]}, r"tip_loads\[0\] is 'constant'.*loads of joint1, joint2"),
        ({"loads": LOAD}, "loads is 'at the tip'.*tip_loads"),
        ({"loads": svsa.PushLoad(torque_nm=(1.0, 0.0, 0.0))}, "joint2.loads is 'push'.*joint 1"),
        ({"tip": ELLIPSE, "position": 0.3}, "arm.tip is 'ellipse'.*replaces"),
        ({"tip": ELLIPSE, "joint2": {"position": 0.3}}, "arm.tip is 'ellipse'.*replaces"),
        ({"tip_loads": 3}, r"^tip_loads\[0\] is 3: it must be a load"),
        ({"joint1": "fl"}, "^joint1 is 'fl': it must be a dict of settings by name"),
        ({"joint2": {1: 2}}, "^joint2 is .* a dict of settings by name"),
        ({"commands": None}, "^commands is missing: it must be a list of svsa.Change"),
    ],
)
def test_invalid_setting_of_an_arm_is_named_in_the_error(given, message):
    with pytest.raises(svsa.ParameterError, match=message):
        svsa.simulate_arm(**given, duration_s=0.01)


def test_one_load_at_the_tip_needs_no_list():
    options = {"law": "fl", "duration_s": 0.05}
    load = LOAD.changed(start_s=0.01)
    written = {"kind": "tip_mass", "mass_kg": 0.1, "start_s": 0.01}
    given = load, [load], written
    one, *others = (svsa.simulate_arm(tip_loads=loads, **options) for loads in given)
    assert [run.samples.tobytes() for run in others] == [one.samples.tobytes()] * 2


def test_options_of_a_configuration_stay_unless_they_are_given():
    on = svsa.simulate_arm(feedforward=True, adaptation=True, duration_s=0.01).configuration
    options = [(True, True), (False, None), (None, False)]
    found = [
        svsa.simulate_arm(on, feedforward=feedforward, adaptation=adaptation, duration_s=0.01)
        for feedforward, adaptation in options
    ]
    setups = [one.configuration.require_arm() for one in found]
    assert [one.feedforward for one in setups] == [True, False, True]
    assert [one.adaptation is None for one in setups] == [False, False, True]


def test_fault_names_its_joint_and_ends_both_joints():
    result = svsa.simulate_arm(
        joint2={"loads": svsa.ConstantLoad(torque_nm=(20.0, 0.0, 0.0), start_s=0.5)}
    )
    assert result.fault is not None
    assert result.fault.lane == 1
    assert result.fault.message.startswith("Joint 2: At 0.5")
    assert result.samples.shape[1] == result.fault.tick
    assert "Ended early: Joint 2" in repr(result)


@pytest.mark.exhaustive
@pytest.mark.parametrize("joints", [1, 4])
def test_arm_of_any_number_of_joints_follows_its_references_and_is_replayed(joints, tmp_path):
    """The feedforward of the exact links leaves the error of the sampling; the mass disturbs."""
    configuration = build_actuated_arm("chain", ["svsa"] * joints)
    change = svsa.Change(at_s=3.0, joint=joints, stiffness={"kind": "constant", **SOFT})
    options = {"duration_s": 4.0, "feedforward": True, "commands": [change]}
    load = svsa.TipMass(mass_kg=0.1, start_s=2.0)
    result = svsa.simulate_arm(configuration, "fl", **options, tip_loads=load)
    assert result.fault is None
    assert len(result.joints) == len(result.samples) == joints
    assert max(np.degrees(result.measure(0.0, 1.9))) < 0.02
    assert min(np.degrees(result.measure(2.5, 4.0))) > 0.05
    assert result.joints[-1].stiffness_nm_per_rad[-1] == pytest.approx(100.0, rel=0.05)
    assert np.all(np.isfinite(result.tip_stiffness_n_per_m[-1])) == (joints > 1)
    folder = svsa.save_run(result, tmp_path / "arm")
    assert svsa.open_arm_run(folder).configuration == result.configuration
    assert svsa.resimulate(folder).identical


def test_arm_has_as_many_joints_as_links_and_no_other():
    chain = RODS.chain * 2
    for wrong, message in (
        ({"arm": RODS, "joint3": {"stiffness": 60.0}}, "joint3 is .*joints of this arm are 1 to 2"),
        ({"arm": RODS.changed(chain=chain[:3]), "tip": ELLIPSE}, "tip is 'ellipse'.*two links"),
        ({"arm": RODS.changed(chain=chain), "model": RODS}, "arm.model.chain is 2: .*4 links"),
        ({"arm": RODS.changed(chain=chain[:3]), "comparisons": "fl"}, "comparisons.*of 3 joints"),
        ({"commands": [svsa.Change(at_s=0.0, joint=3, law="fl")]}, "no joint 3.*1 to 2"),
    ):
        with pytest.raises(svsa.SvsaError, match=message):
            svsa.simulate_arm(duration_s=0.01, **wrong)


@pytest.mark.exhaustive
@pytest.mark.parametrize("actuator", ["awas2", "leaf_spring", "sea"])
def test_other_actuators_move_the_arm(actuator):
    mixed = svsa.simulate_arm(joint2={"actuator": actuator}, duration_s=8.0)
    assert mixed.fault is None
    assert max(measure_deg(mixed, BEFORE_S)) < 0.3


@pytest.mark.exhaustive
def test_arm_with_maccepa_follows_its_references():
    # Faster than the actuator's defaults, which suit a single joint with sensor noise.
    gains = svsa.Gains.from_poles([-60] * 4, [-40] * 2)
    result = svsa.simulate_arm("maccepa", "ndobc", gains=gains, observer=60.0, duration_s=8.0)
    assert result.fault is None
    assert max(measure_deg(result, BEFORE_S)) < 0.15

"""The schematic of each mechanism: correct geometry, drawn at every state of its domain."""

import math

import numpy as np
import pytest
import viser

from svsa.actuators.drawing import draw_torsion_spring
from svsa.actuators.installed import get_mechanism
from svsa_scene.pose import ActuatorPose
from svsa_scene.scene import ActuatorScene
from tests.actuators.members import NAMES

OTHERS = [name for name in NAMES if name != "svsa"]


def draw(name, s, phi):
    mechanism = get_mechanism(name)
    return (mechanism.draw or draw_torsion_spring)(mechanism.prototype, s, phi)


def measure(part):
    return math.dist(part.start, part.end)


def build_pose(s, phi):
    return ActuatorPose(
        position_rad=0.3 + phi,
        position_reference_rad=0.3,
        motor1_position_rad=0.3,
        motor2_position_rad=0.1,
        lever_ratio=s,
        stiffness_nm_per_rad=2.0,
        torque1_nm=0.1,
        torque2_nm=0.0,
        disturbance_link_nm=0.0,
        load_mass_kg=0.0,
        deflection_limit_rad=0.5,
    )


@pytest.fixture(scope="module")
def server():
    started = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    yield started
    started.stop()


@pytest.mark.parametrize("name", OTHERS)
def test_same_parts_are_drawn_at_every_state_inside_the_view(name):
    mechanism = get_mechanism(name)
    kinds = {
        tuple((part.kind, part.body) for part in draw(name, s, phi))
        for s in np.linspace(*mechanism.coordinate, 9)
        for phi in np.linspace(-0.5, 0.5, 9)
    }
    assert len(kinds) == 1
    for s in np.linspace(*mechanism.coordinate, 9):
        for part in draw(name, s, 0.4):
            for point in (part.start, part.end):
                assert math.hypot(*point) < 1.8


@pytest.mark.parametrize("name", OTHERS)
def test_deflection_of_opposite_sign_is_mirrored(name):
    s = sum(get_mechanism(name).coordinate) / 2
    lengths = [sorted(map(measure, draw(name, s, phi))) for phi in (-0.3, 0.3)]
    assert lengths[0] == pytest.approx(lengths[1])


def test_spring_of_maccepa_has_the_length_of_its_energy():
    p = get_mechanism("maccepa").prototype
    (spring,) = [part for part in draw("maccepa", 0.01, 0.6) if part.kind == "spring"]
    B, C = p.arm_m, p.distance_m
    exact = math.sqrt(B**2 + C**2 - 2 * B * C * math.cos(0.6))
    assert measure(spring) / 10 == pytest.approx(exact)
    assert measure(draw("maccepa", 0.01, 0.6)[2]) / 10 == pytest.approx(0.01)


def test_lever_of_awas_is_straight_and_its_pivot_divides_it_as_s():
    outer, inner = (part for part in draw("awas2", 0.4, 0.02) if part.body == "lever")
    assert measure(inner) / measure(outer) == pytest.approx(0.4 / 0.6, rel=2e-3)
    slopes = [(p.end[1] - p.start[1]) / (p.end[0] - p.start[0]) for p in (outer, inner)]
    assert slopes[0] == pytest.approx(slopes[1], rel=2e-3)


def test_arms_of_qbmove_are_two_s_apart_and_a_deflection_stretches_one_spring():
    arms = [part.end for part in draw("qbmove", 0.2, 0.0) if part.body == "motor1"][:2]
    wider = [part.end for part in draw("qbmove", 0.5, 0.0) if part.body == "motor1"][:2]
    angles = [abs(math.atan2(y, -x)) for x, y in (*arms, *wider)]
    assert angles[2] - angles[0] == pytest.approx(0.3)
    at_rest, left, right = (
        [measure(one) for one in draw("qbmove", 0.4, phi) if one.kind == "spring"]
        for phi in (0.0, -0.2, 0.2)
    )
    assert at_rest[0] == pytest.approx(at_rest[1])
    assert left == pytest.approx(right[::-1])
    assert left[0] > at_rest[0] > left[1]


def test_deflection_of_bavs_stretches_the_springs_on_one_side_of_both_motors():
    at_rest, turned = (
        [measure(one) for one in draw("bavs", 0.1, phi) if one.kind == "spring"]
        for phi in (0.0, 0.1)
    )
    assert at_rest[0] > at_rest[1]
    assert at_rest[2] < at_rest[3]
    assert [now > before for now, before in zip(turned, at_rest, strict=True)] == [
        False,
        True,
        False,
        True,
    ]


def test_free_leaf_is_as_long_as_s():
    short, long = (
        next(measure(one) for one in draw("leaf_spring", s, 0.0) if one.kind == "leaf")
        for s in (0.06, 0.12)
    )
    assert long == pytest.approx(2 * short)


@pytest.mark.parametrize("name", OTHERS)
def test_scene_moves_the_parts_of_its_actuator(server, name):
    mechanism = get_mechanism(name)
    server.scene.reset()
    scene = ActuatorScene(server, mechanism.prototype)
    s = sum(mechanism.coordinate) / 2
    scene.update(build_pose(s, 0.0))
    nodes = scene._parts.schematic._nodes
    before = [tuple(node.wxyz) for node in nodes]
    scene.update(build_pose(s, 0.2))
    assert before != [tuple(node.wxyz) for node in nodes]
    for node, part in zip(nodes, draw(name, s, 0.2), strict=True):
        assert tuple(node.position)[:2] == pytest.approx(part.start)

"""An arm on a viser server: links, loads, comparison, path and stiffness ellipse of the tip."""

import math
from typing import Any

import numpy as np
import pytest
import trimesh
import viser

from svsa.actuators.arm.dynamics import compute_tip_position, turn
from svsa.actuators.arm.parameters import MACCEPA_ARM, RODS
from svsa.actuators.installed import get_mechanism
from svsa_scene.arm import ArmScene
from svsa_scene.arm_pose import ArmPose, TipLoad, Wall
from svsa_scene.arm_solids import REACH
from svsa_scene.tip import compute_stiffness_ellipse, compute_tip
from tests.server.scene.poses import make_pose

LENGTHS = (0.3, 0.3)
ARMS = {"rods": (RODS, "svsa"), "maccepa": (MACCEPA_ARM, "maccepa")}


@pytest.fixture(scope="module")
def server():
    started = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    yield started
    started.stop()


def build_scene(server: viser.ViserServer, name: str = "rods") -> ArmScene:
    server.scene.reset()
    links, actuator = ARMS[name]
    parameters = get_mechanism(actuator).prototype
    return ArmScene(server, links, (parameters, parameters))


def build_arm_pose(q1: float, q2: float, stiffness: float = 15.0, **changes: Any) -> ArmPose:
    first, second = (make_pose(q, stiffness_nm_per_rad=stiffness) for q in (q1, q2))
    return ArmPose((first, second), **changes)


def get_node(server: viser.ViserServer, name: str) -> Any:
    return server.scene.get_handle_by_name(name)


def place(server: viser.ViserServer, *names: str) -> np.ndarray:
    """World matrix of the last of these nodes, each a child of the one before."""
    matrix = np.eye(4)
    for name in names:
        node = get_node(server, name)
        own = trimesh.transformations.quaternion_matrix(node.wxyz)
        own[:3, 3] = node.position
        matrix = matrix @ own
    return matrix


@pytest.mark.parametrize("name", ARMS)
def test_tip_of_the_drawn_links_is_that_of_the_model(server: viser.ViserServer, name: str) -> None:
    scene = build_scene(server, name)
    scene.update(build_arm_pose(0.5, -0.9))
    links = place(server, "/a", "/a/l", "/a/l/2", "/a/l/2/l")
    metres = [link.length_m for link in ARMS[name][0].chain]
    lengths = [REACH * length / sum(metres) for length in metres]
    tip = links @ (lengths[1], 0.0, 0.0, 1.0)
    assert tip[1:3] == pytest.approx(compute_tip(lengths, (0.5, -0.9)))


@pytest.mark.parametrize("q", [(0.3, 0.9), (-0.8, -1.7), (2.9, 0.2)])
def test_ellipse_has_the_axes_of_the_matrix_of_the_tip(q: tuple[float, float]) -> None:
    """K = J⁻ᵀ diag(σ1, σ2) J⁻¹ with the Jacobian by differences of `compute_tip`."""
    sigma, step = (80.0, 20.0), 1e-6
    columns = [
        np.subtract(compute_tip(LENGTHS, (q[0] + d1, q[1] + d2)), compute_tip(LENGTHS, q)) / step
        for d1, d2 in ((step, 0.0), (0.0, step))
    ]
    inverse = np.linalg.inv(np.stack(columns, 1))
    values, vectors = np.linalg.eigh(inverse.T @ np.diag(sigma) @ inverse)
    ellipse = compute_stiffness_ellipse(LENGTHS, q, sigma)
    assert ellipse is not None
    assert (ellipse.least, ellipse.greatest) == pytest.approx(tuple(values), rel=1e-4)
    direction = math.cos(ellipse.angle), math.sin(ellipse.angle)
    assert abs(np.dot(direction, vectors[:, 1])) == pytest.approx(1.0)


def test_tip_is_that_of_the_arm_of_the_simulation() -> None:
    for q in ((0.3, 0.9), (-0.8, -1.7)):
        tip = compute_tip_position(RODS.build(), turn(q))
        assert compute_tip(LENGTHS, q) == pytest.approx((tip.x, tip.y))


def test_straight_arm_has_no_ellipse(server: viser.ViserServer) -> None:
    assert compute_stiffness_ellipse(LENGTHS, (0.4, 0.0), (80.0, 80.0)) is None
    scene = build_scene(server)
    scene.update(build_arm_pose(0.4, 1.0))
    assert get_node(server, "/a/k").visible
    scene.update(build_arm_pose(0.4, 0.0))
    assert not get_node(server, "/a/k").visible


def test_ellipse_grows_with_the_root_of_the_stiffness(server: viser.ViserServer) -> None:
    scene = build_scene(server)
    scene.update(build_arm_pose(0.4, 1.0, 10.0))
    soft = get_node(server, "/a/k/d").scale
    scene.update(build_arm_pose(0.4, 1.0, 40.0))
    stiff = get_node(server, "/a/k/d").scale
    assert stiff[:2] == pytest.approx((2.0 * soft[0], 2.0 * soft[1]))


def test_axis_of_the_ellipse_has_the_direction_of_the_greatest_stiffness(
    server: viser.ViserServer,
) -> None:
    scene = build_scene(server)
    scene.update(build_arm_pose(0.4, 1.0))
    ellipse = compute_stiffness_ellipse(LENGTHS, (0.4, 1.0), (15.0, 15.0))
    assert ellipse is not None
    axis = place(server, "/a", "/a/k") @ (1.0, 0.0, 0.0, 0.0)
    assert axis[1:3] == pytest.approx((math.cos(ellipse.angle), math.sin(ellipse.angle)), abs=1e-6)


def test_loads_at_the_tip_are_drawn_while_they_act(server: viser.ViserServer) -> None:
    scene = build_scene(server)
    nodes = "/a/w", "/a/f", "/a/wall"
    scene.update(build_arm_pose(0.4, 1.0))
    assert not any(get_node(server, name).visible for name in nodes)
    load = TipLoad(mass_kg=0.3, force_n=(3.0, 4.0), wall=Wall(math.pi, 0.2))
    scene.update(build_arm_pose(0.4, 1.0, load=load))
    assert all(get_node(server, name).visible for name in nodes)
    assert get_node(server, "/a/w/t").text == "0.3 kg"
    assert get_node(server, "/a/f/h/t").text == "5 N"
    force = place(server, "/a", "/a/f") @ (0.0, 1.0, 0.0, 0.0)
    assert force[1:3] == pytest.approx((0.6, 0.8))
    inside = place(server, "/a", "/a/wall") @ (0.0, 0.0, 0.0, 1.0)
    assert inside[1:3] == pytest.approx((-0.2 * REACH / 0.6, 0.0))


def test_reference_and_comparison_are_arms_of_their_own(server: viser.ViserServer) -> None:
    scene = build_scene(server)
    scene.update(build_arm_pose(0.4, 1.0))
    assert get_node(server, "/a/g").wxyz[3] == pytest.approx(math.sin(0.2))
    assert not get_node(server, "/a/r").visible
    scene.update(build_arm_pose(0.4, 1.0, comparison=(0.1, 0.6), comparison_name="FL"))
    assert get_node(server, "/a/r").visible
    assert get_node(server, "/a/r/2").wxyz[3] == pytest.approx(math.sin(0.3))
    assert get_node(server, "/a/r/2/t").text == "FL"


def test_path_follows_the_tip_and_restarts_after_a_jump(server: viser.ViserServer) -> None:
    scene = build_scene(server)
    for step in range(12):
        scene.update(build_arm_pose(0.02 * step, 1.0))
    points = get_node(server, "/a/t").points
    x, y = compute_tip((REACH / 2, REACH / 2), (0.22, 1.0))
    assert points[-1, 1, :2] == pytest.approx((-y, x), rel=1e-5)
    assert len(points) == 5
    for _ in range(6):
        scene.update(build_arm_pose(-1.5, 1.0))
    assert len(get_node(server, "/a/t").points) == 2


def test_whole_path_can_be_drawn_at_once(server: viser.ViserServer) -> None:
    scene = build_scene(server)
    angles = np.linspace([0.0, 0.5], [1.0, 1.0], 50)
    angles[7] = np.nan
    scene.draw_paths(angles, angles[:20])
    assert len(get_node(server, "/a/t").points) == 48
    assert len(get_node(server, "/a/td").points) == 18


def test_pose_without_a_number_keeps_the_last_one(server: viser.ViserServer) -> None:
    scene = build_scene(server)
    scene.update(build_arm_pose(0.4, 1.0))
    scene.update(build_arm_pose(math.nan, 1.0))
    scene.update(build_arm_pose(0.8, 1.0, load=TipLoad(force_n=(math.nan, 0.0))))
    assert get_node(server, "/a/l").wxyz[3] == pytest.approx(math.sin(0.2))

"""Torques as arrows and other lanes as outlines on a viser server."""

import contextlib
import io
import math
from collections.abc import Iterator
from typing import Any

import pytest
import trimesh
import viser

from svsa_scene import ComparisonPose
from svsa_scene.arrows import SMALLEST_NM, compute_arc
from svsa_scene.scene import ActuatorScene
from tests.server.scene.poses import make_pose


@pytest.fixture
def server() -> Iterator[viser.ViserServer]:
    with contextlib.redirect_stdout(io.StringIO()):
        server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    yield server
    server.stop()


def get_node(server: viser.ViserServer, name: str) -> Any:
    return server.scene.get_handle_by_name(name)


def compute_tip(server: viser.ViserServer, name: str) -> float:
    """Return the angle about the axis from the start to the end of the arrow's arc."""
    root = trimesh.transformations.quaternion_matrix(get_node(server, name).wxyz)
    head = trimesh.transformations.quaternion_matrix(get_node(server, f"{name}/h").wxyz)
    tip = root @ head @ (1.0, 0.0, 0.0, 0.0)
    return math.atan2(tip[1], tip[0])


def test_arrow_shows_magnitude_and_sign_and_is_hidden_when_small(
    server: viser.ViserServer,
) -> None:
    scene = ActuatorScene(server)
    arrow = get_node(server, "/a/l/w2")
    assert not arrow.visible
    scene.update(make_pose(disturbance_link_nm=2.0))
    assert arrow.visible
    assert compute_tip(server, "/a/l/w2") == pytest.approx(compute_arc(2.0))
    scene.update(make_pose(disturbance_link_nm=-2.0))
    assert compute_tip(server, "/a/l/w2") == pytest.approx(-compute_arc(2.0))
    scene.update(make_pose(disturbance_link_nm=0.001))
    assert not arrow.visible


@pytest.mark.parametrize("torque_nm", [0.05, 0.3, 2.0, 9.0, 500.0])
def test_segments_of_an_arc_end_at_its_head(server: viser.ViserServer, torque_nm: float) -> None:
    scene = ActuatorScene(server)
    scene.update(make_pose(torque1_nm=40.0))
    scene.update(make_pose(torque1_nm=torque_nm))
    piece = compute_arc(SMALLEST_NM)
    seen = [get_node(server, f"/a/u1/{number}").visible for number in range(7)]
    ends = sum(seen) * piece
    assert seen == sorted(seen, reverse=True)
    assert compute_arc(torque_nm) - piece <= ends + 1e-9 <= compute_arc(torque_nm) + 2e-9


def test_arrows_grow_with_the_torque_to_a_maximum() -> None:
    arcs = [compute_arc(torque) for torque in (0.01, 0.1, 1.0, -5.0, 15.0, 500.0)]
    assert arcs == sorted(arcs)
    assert len(set(arcs)) == len(arcs)
    assert arcs[0] == 0.0
    assert arcs[-1] == compute_arc(1e9) < 2 * math.pi


def test_each_torque_has_its_own_arrow(server: viser.ViserServer) -> None:
    scene = ActuatorScene(server)
    torques = {
        "torque1_nm": "/a/u1",
        "torque2_nm": "/a/u2",
        "disturbance_motor1_nm": "/a/w4",
        "disturbance_motor2_nm": "/a/w6",
    }
    for field, name in torques.items():
        scene.update(make_pose(**{field: 1.0}))
        shown = {other for other in torques.values() if get_node(server, other).visible}
        assert shown == {name}


def test_other_lanes_are_outlines_with_their_law(server: viser.ViserServer) -> None:
    scene = ActuatorScene(server)
    scene.update(make_pose(comparisons=(ComparisonPose("FL", 0.5),)))
    outline = get_node(server, "/a/r0")
    assert outline.visible
    assert outline.wxyz[3] == pytest.approx(math.sin(0.25))
    assert get_node(server, "/a/r0/t").text == "FL"
    assert not get_node(server, "/a/r1").visible
    scene.update(make_pose(comparisons=(ComparisonPose("FL", math.nan),)))
    assert outline.wxyz[3] == pytest.approx(math.sin(0.25))
    scene.update(make_pose())
    assert not outline.visible

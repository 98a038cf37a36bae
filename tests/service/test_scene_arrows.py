"""Torques as arrows and the other lanes as outlines, as a viser server holds them."""

import contextlib
import io
import math
from collections.abc import Iterator
from typing import Any

import pytest
import viser

from svsa_scene import ActuatorScene, RivalPose
from svsa_scene.arrows import compute_arrow_length
from tests.service.poses import make_pose


@pytest.fixture
def server() -> Iterator[viser.ViserServer]:
    with contextlib.redirect_stdout(io.StringIO()):
        server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
    yield server
    server.stop()


def get_node(server: viser.ViserServer, name: str) -> Any:
    return server.scene.get_handle_by_name(name)


def test_an_arrow_shows_size_and_sign_and_is_hidden_when_small(server: viser.ViserServer) -> None:
    scene = ActuatorScene(server)
    arrow = get_node(server, "/a/l/w2")
    assert not arrow.visible
    scene.update(make_pose(disturbance_link_nm=2.0))
    assert arrow.visible
    assert arrow.wxyz[0] == pytest.approx(1.0)
    assert get_node(server, "/a/l/w2/h").position[1] == pytest.approx(compute_arrow_length(2.0))
    scene.update(make_pose(disturbance_link_nm=-2.0))
    assert arrow.wxyz[3] == pytest.approx(1.0)
    scene.update(make_pose(disturbance_link_nm=0.001))
    assert not arrow.visible


def test_arrows_grow_with_the_torque_up_to_an_end() -> None:
    lengths = [compute_arrow_length(torque) for torque in (0.01, 0.1, 1.0, -5.0, 15.0, 500.0)]
    assert lengths == sorted(lengths)
    assert lengths[0] == 0.0
    assert lengths[-1] == compute_arrow_length(1e9)


def test_each_torque_has_an_arrow_of_its_own(server: viser.ViserServer) -> None:
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
    scene.update(make_pose(rivals=(RivalPose("FL", 0.5),)))
    outline = get_node(server, "/a/r0")
    assert outline.visible
    assert outline.wxyz[3] == pytest.approx(math.sin(0.25))
    assert get_node(server, "/a/r0/t").text == "FL"
    assert not get_node(server, "/a/r1").visible
    scene.update(make_pose(rivals=(RivalPose("FL", math.nan),)))
    assert outline.wxyz[3] == pytest.approx(math.sin(0.25))
    scene.update(make_pose())
    assert not outline.visible

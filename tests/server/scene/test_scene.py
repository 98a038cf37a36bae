"""The 3D view: it follows its session while a client watches."""

import asyncio
import math

import msgspec
import pytest
import websockets

from svsa.runs.definition.paper import get_figure
from svsa_scene.linkage import RADIUS, compute_linkage
from tests.server.scene.poses import make_pose
from tests.server.scene.viewed_lab import (
    CAMERA,
    LINK,
    SUBPROTOCOL,
    Lab,
    receive_until,
    run_in_lab,
    wait_for,
)


@pytest.mark.parametrize("path", ["/viser/lab/", "/viser/lab"])
def test_websocket_shows_the_scene_and_follows_the_pose(path: str) -> None:
    async def check(lab: Lab) -> None:
        async with lab.connect(path=path) as browser:
            assert browser.subprotocol == SUBPROTOCOL
            await receive_until(browser, lambda m: m.get("name") == LINK)
            await browser.send(msgspec.msgpack.encode(CAMERA))
            await wait_for(lambda: lab.reads > 0)
            lab.poses["lab"] = make_pose(1.0)
            turned = await receive_until(
                browser,
                lambda m: (
                    m["type"] == "SetOrientationMessage" and m["name"] == LINK and m["wxyz"][3] > 0
                ),
            )
            assert turned["wxyz"] == pytest.approx([math.cos(0.5), 0, 0, math.sin(0.5)])
        await wait_for(lambda: lab.bridge.viewers == 0)

    run_in_lab(check)


def test_private_session_has_its_own_view_that_ends_with_it() -> None:
    async def check(lab: Lab) -> None:
        private = lab.laboratory.create(get_figure("4a").build_configuration()).session.name
        lab.poses[private] = make_pose(-1.0)
        async with lab.connect() as shared, lab.connect(path=f"/viser/{private}/") as own:
            assert set(lab.scenes.views) == {"lab", private}
            await own.send(msgspec.msgpack.encode(CAMERA))
            turned = await receive_until(
                own, lambda m: m["type"] == "SetOrientationMessage" and m["name"] == LINK
            )
            assert turned["wxyz"][3] < 0
            await receive_until(shared, lambda m: m.get("name") == LINK)
            lab.laboratory.end(private)
            with pytest.raises(websockets.ConnectionClosed):
                await receive_until(own, lambda _: False)
        assert set(lab.scenes.views) == {"lab"}
        with pytest.raises(websockets.InvalidStatus):
            async with lab.connect(path=f"/viser/{private}/"):
                pass

    run_in_lab(check)


def test_private_view_without_viewers_ends(monkeypatch: pytest.MonkeyPatch) -> None:
    async def check(lab: Lab) -> None:
        private = lab.laboratory.create(get_figure("4a").build_configuration()).session.name
        async with lab.connect(path=f"/viser/{private}/") as own:
            await own.send(msgspec.msgpack.encode(CAMERA))
            await wait_for(lambda: lab.scenes.views[private].bridge.viewers == 1)
            # Only now: a busy machine may need longer to count the viewer.
            monkeypatch.setattr("svsa_server.scene.scenes.IDLE_S", 0.0)
            await asyncio.sleep(0.5)
            assert private in lab.scenes.views
        await wait_for(lambda: not lab.scenes.views)

    run_in_lab(check)


def test_nothing_is_started_or_read_without_viewers() -> None:
    async def check(lab: Lab) -> None:
        await asyncio.sleep(0.15)
        assert not lab.scenes.views
        await lab.scenes.open("lab")
        await asyncio.sleep(0.15)
        assert lab.reads == 0

    run_in_lab(check)


def test_lever_passes_through_the_pivot_at_the_lever_ratio() -> None:
    pose = make_pose(0.3, motor1_position_rad=0.1, lever_ratio=0.6)
    linkage = compute_linkage(pose)
    assert linkage.pivot_radius == pytest.approx(0.6 * RADIUS)
    assert linkage.deflection == pytest.approx(0.2)
    pivot_x = -linkage.pivot_radius * math.cos(0.2)
    pivot_y = linkage.pivot_radius * math.sin(0.2)
    assert math.tan(linkage.lever_angle) == pytest.approx(pivot_y / (pivot_x + RADIUS))
    assert linkage.block_offset == pytest.approx(RADIUS * math.tan(linkage.lever_angle))
    assert linkage.spring_left - linkage.spring_right == pytest.approx(2 * linkage.block_offset)

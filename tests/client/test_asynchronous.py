"""The asynchronous client: the methods of the blocking client, by the same names."""

import asyncio

import numpy as np
import pytest

import svsa
from svsa.client import Lab, LabError, Loads, RemoteSession
from tests.lab import Lab as Server


@pytest.fixture
def server(lab: Server) -> Server:
    return lab


def test_run_is_configured_loaded_watched_and_recorded(server: Server) -> None:
    async def work() -> None:
        async with svsa.connect_async(server.url) as lab, lab.new_session(load=False) as session:
            await session.pause()
            sine = svsa.SinePosition(amplitude_rad=0.5, frequency_hz=0.3)
            await session.set(position=sine, law="fl")
            assert session.applied_at is not None
            configuration = (await session.read_state())["configuration"]
            assert (configuration["law"], configuration["position"]["amplitude_rad"]) == ("fl", 0.5)
            async with session.record("awaited") as recording:
                load = await session.loads.add(svsa.PaperLoad())
                assert [one async for one in session.loads] == [load]
                await session.start()
                stream = session.stream("position_rad", duration_s=0.2)
                blocks = [block async for block in stream]
                await session.loads.remove(load)
            result = await recording.read_result()
        ticks = np.concatenate([block.ticks for block in blocks])
        first = round(float(result.time_s[0]) / blocks[0].period_s)
        streamed = np.concatenate([block["position_rad"] for block in blocks])
        assert np.array_equal(streamed, result.position_rad[ticks - first].astype("f4"))
        assert [command.kind for command in result.commands][-2:] == ["load", "unload"]

    asyncio.run(work())


def test_parallel_sessions_give_the_runs_of_the_library(server: Server) -> None:
    async def work() -> list[svsa.Result]:
        async with svsa.connect_async(server.url) as lab:
            laws = [lab.run("4a", law, duration_s=0.3) for law in ("fl", "ndobc", "pd")]
            return await asyncio.gather(*laws)

    for law, there in zip(("fl", "ndobc", "pd"), asyncio.run(work()), strict=True):
        here = svsa.simulate("4a", law, duration_s=0.3)
        assert np.array_equal(there.samples, here.samples)


def test_rejection_and_missing_lab_raise_the_errors_of_the_blocking_client(server: Server) -> None:
    async def reject() -> None:
        async with svsa.connect_async(server.url) as lab, lab.new_session(load=False) as session:
            await session.set(law="missing")

    with pytest.raises(svsa.ParameterError, match="missing"):
        asyncio.run(reject())

    async def miss() -> None:
        await svsa.connect_async("http://127.0.0.1:9", timeout_s=0.0)

    with pytest.raises(LabError, match="does not answer"):
        asyncio.run(miss())


def test_every_method_of_the_blocking_client_is_awaitable_by_its_name(server: Server) -> None:
    async def work() -> None:
        lab = await svsa.connect_async(server.url)
        async with lab, lab.new_session(load=False) as session:
            await session.pause()
            await session.set_laws("fl")
            assert await session.get("law") == "fl"
            for kind, one in ((Lab, lab), (RemoteSession, session), (Loads, session.loads)):
                public = [name for name in vars(kind) if not name.startswith("_")]
                calls = [name for name in public if callable(getattr(kind, name))]
                assert calls
                assert all(callable(getattr(one, name)) for name in calls)
            with pytest.raises(svsa.StateError, match="no bench"):
                await session.bench.arm()

    asyncio.run(work())


def test_unknown_name_is_rejected_by_both_clients_and_sets_nothing(server: Server) -> None:
    async def work() -> None:
        async with svsa.connect_async(server.url) as lab, lab.new_session(load=False) as session:
            with pytest.raises(AttributeError, match=r"await session\.set\(law=…\)"):
                session.law = "fl"
            with pytest.raises(AttributeError, match=r"session\.get\('time_s'\)"):
                _ = session.time_s
            before = (await session.read_state())["configuration"]
            with pytest.raises(TypeError, match=r"no setting 'lawx'; the nearest is law"):
                await session.set(gains=svsa.Gains.from_poles([-20.0] * 4, [-20.0] * 2), lawx=1)
            assert (await session.read_state())["configuration"] == before

    asyncio.run(work())
    with svsa.connect(server.url) as lab, lab.new_session(load=False) as session:
        before = session.read_state()["configuration"]
        with pytest.raises(AttributeError, match=r"no attribute 'lawx'; the nearest is law"):
            session.lawx = "fl"  # pyright: ignore[reportAttributeAccessIssue]
        with pytest.raises(TypeError, match=r"no setting 'positon'; the nearest is position"):
            session.set(law="fl", positon=svsa.ConstantPosition())
        with pytest.raises(AttributeError, match=r"no property 'tme_s'; the nearest is time_s"):
            session.get("tme_s")
        with pytest.raises(AttributeError):
            session.status = "paused"  # pyright: ignore[reportAttributeAccessIssue]
        assert session.read_state()["configuration"] == before

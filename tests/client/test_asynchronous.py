"""The client of a program that awaits: the calls of the other, beside its own work."""

import asyncio

import numpy as np
import pytest

import svsa
from svsa.client import LabError
from tests.lab import Lab as Server


@pytest.fixture
def server(lab: Server) -> Server:
    return lab


def test_a_run_is_set_loaded_watched_and_recorded(server: Server) -> None:
    async def work() -> None:
        async with await svsa.connect_async(server.url) as lab, lab.private(load=False) as session:
            await session.pause()
            sine = svsa.SinePosition(amplitude_rad=0.5, frequency_hz=0.3)
            await session.set(position=sine, law="fl")
            assert session.acted is not None
            configuration = (await session.read_state())["configuration"]
            assert (configuration["law"], configuration["position"]["amplitude_rad"]) == ("fl", 0.5)
            async with session.record("awaited") as recording:
                load = await session.add_load(svsa.PaperLoad())
                await session.start()
                stream = session.stream("position_rad", duration_s=0.2)
                blocks = [block async for block in stream]
                await session.remove_load(load)
            result = await recording.read_result()
        ticks = np.concatenate([block.ticks for block in blocks])
        first = round(float(result.time_s[0]) / blocks[0].period_s)
        streamed = np.concatenate([block["position_rad"] for block in blocks])
        assert np.array_equal(streamed, result.position_rad[ticks - first].astype("f4"))
        assert [command.kind for command in result.commands][-2:] == ["load", "unload"]

    asyncio.run(work())


def test_several_go_on_side_by_side_and_give_the_library_s_runs(server: Server) -> None:
    async def work() -> list[svsa.Result]:
        async with await svsa.connect_async(server.url) as lab:
            laws = [lab.run("4a", law, duration_s=0.3) for law in ("fl", "ndobc", "pd")]
            return await asyncio.gather(*laws)

    for law, there in zip(("fl", "ndobc", "pd"), asyncio.run(work()), strict=True):
        here = svsa.simulate("4a", law, duration_s=0.3)
        assert np.array_equal(there.samples, here.samples)


def test_a_refusal_and_a_missing_lab_are_told_as_by_the_other(server: Server) -> None:
    async def refuse() -> None:
        async with await svsa.connect_async(server.url) as lab, lab.private(load=False) as session:
            await session.set(law="nobody")

    with pytest.raises(svsa.ParameterError, match="nobody"):
        asyncio.run(refuse())
    with pytest.raises(LabError, match="does not answer"):
        asyncio.run(svsa.connect_async("http://127.0.0.1:9", patience_s=0.0))


def test_every_method_of_the_blocking_client_is_awaited_by_its_name(server: Server) -> None:
    async def work() -> None:
        async with await svsa.connect_async(server.url) as lab, lab.private(load=False) as session:
            await session.pause()
            await session.set_laws("fl")
            configuration = (await session.read_state())["configuration"]
            assert configuration["law"] == "fl"
            assert {"set_laws", "run_until", "record"} <= set(dir(session))
            with pytest.raises(AttributeError, match="no call 'time_s'"):
                _ = session.time_s
            with pytest.raises(TypeError, match="No setting of a session: lwa"):
                await session.set(
                    position=svsa.SinePosition(amplitude_rad=0.1, frequency_hz=0.2), lwa="fl"
                )
            unchanged = (await session.read_state())["configuration"]
            assert unchanged["position"] == configuration["position"]

    asyncio.run(work())

"""A running lab from a program that awaits: the same calls, none of which blocks its loop.

    async with await svsa.connect_async("http://127.0.0.1:8000") as lab:
        await lab.session.set(position=svsa.SinePosition(amplitude_rad=0.5, frequency_hz=0.2))
        async with lab.session.record("3 kg") as recording:
            await lab.session.add_load(svsa.PaperLoad())
            async for block in lab.session.stream("position_rad", duration_s=5.0):
                print(block.time_s[-1], block["position_rad"][-1])
        result = await recording.read_result()

Each call is that of the blocking client, in a thread of its own. Where the task that awaits one
is cancelled, the lab may carry it out all the same.
"""

import asyncio
from collections.abc import AsyncIterator, Callable, Sequence
from contextlib import asynccontextmanager
from typing import Any, Literal, Self, TypedDict, Unpack

from svsa.actuators.parameters import ActuatorParameters
from svsa.client.connection import Acted
from svsa.client.lab import SHARED, Lab, connect
from svsa.client.loads import AppliedLoad
from svsa.client.runs import Recording
from svsa.client.session import RemoteBench, RemoteSession
from svsa.client.stream import BlockStream
from svsa.control.gains import Gains
from svsa.control.observers.disturbance import ObserverBandwidth
from svsa.runs.change import Change
from svsa.runs.configuration import Configuration, Lane
from svsa.runs.paper import DURATION_S, Figure
from svsa.runs.result.channels import ChannelName
from svsa.runs.result.result import Result
from svsa.simulation.plant.effects import Effects
from svsa.simulation.plant.loads import Load
from svsa.simulation.reference.trajectories import PositionReference, StiffnessReference


class Settings(TypedDict, total=False):
    """What can be set of a session, as the properties of `RemoteSession`."""

    position: PositionReference
    stiffness: StiffnessReference
    law: str
    gains: Gains
    observer: ObserverBandwidth
    effects: Effects
    actuator: ActuatorParameters
    nominal: ActuatorParameters
    comparisons: Sequence[Lane]


async def connect_async(
    url: str = "http://127.0.0.1:8000", token: str | None = None, **options: Any
) -> "AsyncLab":
    """A running lab; options: those of `svsa.connect`. Raises `LabError` where none answers."""
    return AsyncLab(await asyncio.to_thread(connect, url, token, **options))


class AsyncLab:
    """A running lab over its public API. lab: the blocking client, which does the work."""

    def __init__(self, lab: Lab) -> None:
        self.lab = lab
        self.session = self.open_session(SHARED)

    async def __aenter__(self) -> Self:
        return self

    async def __aexit__(self, *_: object) -> None:
        await self.close()

    async def close(self) -> None:
        """End the connection; sessions and recordings of the lab go on."""
        await asyncio.to_thread(self.lab.close)

    def open_session(self, name: str) -> "AsyncSession":
        """The session of this name; whether it is there shows at the first call."""
        return AsyncSession(self.lab.open_session(name))

    @asynccontextmanager
    async def private(
        self, figure: str = "4a", law: str = "ndobc", **settings: Any
    ) -> "AsyncIterator[AsyncSession]":
        """A private session that ends with the block."""
        session = await asyncio.to_thread(self.lab.create_session, figure, law, **settings)
        try:
            yield AsyncSession(session)
        finally:
            await asyncio.to_thread(session.end)

    async def run(
        self,
        experiment: str | Figure | Configuration = "4a",
        law: str | None = None,
        *,
        duration_s: float = DURATION_S,
        commands: Sequence[Change] = (),
        name: str = "",
        **changes: Any,
    ) -> Result:
        """Simulate a run in the lab, record it there, and return it as `svsa.simulate` would."""
        given: dict[str, Any] = {"duration_s": duration_s, "commands": commands, "name": name}
        return await asyncio.to_thread(self.lab.run, experiment, law, **given, **changes)

    async def open_run(self, run_id: str) -> Result:
        """The result of a recorded run."""
        return await asyncio.to_thread(self.lab.runs.__getitem__, run_id)


class AsyncSession:
    """A session. session: the blocking one, whose properties and calls are awaited here."""

    def __init__(self, session: RemoteSession) -> None:
        self.session = session

    @property
    def acted(self) -> Acted | None:
        """When the last command acted; None before the first."""
        return self.session.acted

    async def read_state(self) -> dict[str, Any]:
        """All that `GET /sessions/{session}` says of it, at this instant."""
        return await asyncio.to_thread(self.session.read_state)

    async def set(self, **settings: Unpack[Settings]) -> None:
        """Set what is given, in that order; returns when the last one holds.

        What the lab refuses raises `ParameterError` or `StateError`; what was set before it stays.
        """
        for name, value in settings.items():
            await asyncio.to_thread(setattr, self.session, name, value)

    async def repeat_position(self) -> None:
        """Begin the position reference again, faded over."""
        await asyncio.to_thread(self.session.repeat_position)

    async def repeat_stiffness(self) -> None:
        """Begin the stiffness reference again, faded over."""
        await asyncio.to_thread(self.session.repeat_stiffness)

    async def set_parameters(self, law: str, **values: float) -> None:
        """Parameters of a law that has its own; what is left out stays."""
        await asyncio.to_thread(self.session.set_parameters, law, **values)

    async def add_load(self, load: Load) -> AppliedLoad:
        """Apply a load, now or at its `start_s`."""
        return await asyncio.to_thread(self.session.loads.add, load)

    async def remove_load(self, load: AppliedLoad | int) -> None:
        """Take one off."""
        await asyncio.to_thread(self.session.loads.remove, load)

    async def start(self) -> None:
        """Run on from where it is."""
        await asyncio.to_thread(self.session.start)

    async def pause(self) -> None:
        """Stop time; on a bench, ramp down."""
        await asyncio.to_thread(self.session.pause)

    async def quick_stop(self) -> None:
        """Zero current at once on a bench, latched until cleared; a simulation pauses."""
        await asyncio.to_thread(self.session.quick_stop)

    async def reset(self) -> None:
        """Begin again at t = 0 with everything as it is set now."""
        await asyncio.to_thread(self.session.reset)

    async def set_speed(self, factor: float | Literal["max"]) -> None:
        """Session seconds a wall second, or as fast as it goes."""
        await asyncio.to_thread(self.session.set_speed, factor)

    async def run_until(self, time_s: float) -> None:
        """Run a paused simulation to this time; raises `FaultError` where it ends before."""
        await asyncio.to_thread(self.session.run_until, time_s)

    async def take_control(self, by: str, take_over: bool = False) -> None:
        """Only this script may command from now on; everybody may pause and stop it."""
        await asyncio.to_thread(self.session.take_control, by, take_over)

    async def give_control_back(self) -> None:
        """Everybody may command again."""
        await asyncio.to_thread(self.session.give_control_back)

    async def report_bench(self, call: Callable[[RemoteBench], None]) -> None:
        """A call of the bench, as `await session.report_bench(RemoteBench.arm)`."""
        await asyncio.to_thread(call, self.session.bench)

    @asynccontextmanager
    async def record(
        self, name: str = "", tags: tuple[str, ...] = (), notes: str = ""
    ) -> "AsyncIterator[AsyncRecording]":
        """Record every sample and command within the block."""
        recording = await asyncio.to_thread(self.session.record, name, tags, notes)
        try:
            yield AsyncRecording(recording)
        finally:
            await asyncio.to_thread(recording.stop)

    def stream(
        self,
        *channels: ChannelName,
        duration_s: float = float("inf"),
        rate_hz: float = 200.0,
        lanes: tuple[int, ...] | None = (1,),
        history_s: float = 0.0,
    ) -> BlockStream:
        """Samples as they come, for `async for`; see `RemoteSession.stream`."""
        return self.session.stream(
            *channels, duration_s=duration_s, rate_hz=rate_hz, lanes=lanes, history_s=history_s
        )


class AsyncRecording:
    """A recording, in the lab's list. run_id: its id there."""

    def __init__(self, recording: Recording) -> None:
        self._recording = recording
        self.run_id = recording.run_id

    async def read_result(self) -> Result:
        """The run as `svsa.simulate` would have returned it, once it has ended."""
        return await asyncio.to_thread(lambda: self._recording.result)

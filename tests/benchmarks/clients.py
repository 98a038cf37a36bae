"""`python -m tests.benchmarks.clients [N] [COMMANDS] [SECONDS]`: N watch one session, commands a
second.

Measures the time from sending a command to the first sample on a stream that shows its effect.
"""

import asyncio
import multiprocessing
import sys
import time

import httpx
import numpy as np
from websockets.asyncio.client import connect

from svsa.client.stream import Block, BlockReader
from tests.benchmarks.sessions import read_cpu_seconds, watch
from tests.lab import Lab, run_lab

OBSERVER = "/api/v1/sessions/lab/observer"


def watch_in_parallel(address: str, count: int, seconds: float) -> None:
    """Open several streams of one session in a separate process."""

    async def watch_all() -> None:
        await asyncio.gather(*(watch(address, seconds) for _ in range(count)))

    asyncio.run(watch_all())


def find_delays(
    sent: list[tuple[int, float]], came: list[tuple[int, float]], count: int
) -> np.ndarray:
    """Seconds from each of `count` commands to the first sample that shows it; NaN where none came.

    sent: for each answered command, the tick from which it acted and the time at which it was sent.
    came: for each block, its last tick and its arrival time, which may be earlier than that of the
    answer.
    """
    ticks, times = np.array(came).T
    delays = np.full(count, np.nan)
    for number, (tick, began) in enumerate(sent):
        place = np.searchsorted(ticks, tick)
        if place < len(ticks):
            delays[number] = times[place] - began
    return delays


async def measure(lab: Lab, rate: float, seconds: float) -> np.ndarray:
    """`find_delays` for commands at this rate and for this duration."""
    sent: list[tuple[int, float]] = []
    came: list[tuple[int, float]] = []
    count = round(rate * seconds)

    def note(block: Block | None) -> None:
        if block is not None:
            came.append((int(block.ticks[-1]), time.monotonic()))

    async def read() -> None:
        async with connect(lab.stream_url, proxy=None, max_size=None) as stream:
            reader = BlockReader()
            async for message in stream:
                note(reader.read(message))

    async def command(client: httpx.AsyncClient, number: int) -> None:
        body = {"bandwidth_rad_per_s": [40.0 + number % 20] * 3}
        began = time.monotonic()
        state = (await client.put(OBSERVER, json=body)).raise_for_status().json()
        acted = [event["tick"] for event in state["events"] if event["tick"] <= state["tick"]]
        sent.append((acted[-1] if acted else state["tick"], began))

    watching = asyncio.create_task(read())
    async with (
        httpx.AsyncClient(base_url=lab.url, timeout=30, trust_env=False) as client,
        asyncio.TaskGroup() as group,
    ):
        start = time.monotonic()
        for number in range(count):
            await asyncio.sleep(max(0.0, start + number / rate - time.monotonic()))
            group.create_task(command(client, number))
    await asyncio.sleep(1.0)
    watching.cancel()
    return find_delays(sent, came, count)


def main() -> None:
    """Print the delays of commands, and whether the session ran in real time."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    rate = float(sys.argv[2]) if len(sys.argv) > 2 else 50.0
    seconds = float(sys.argv[3]) if len(sys.argv) > 3 else 20.0
    with run_lab() as lab:
        lab.load_figure()
        asked = (lab.stream_url, count - 1, seconds + 3.0)
        others = multiprocessing.get_context("spawn").Process(target=watch_in_parallel, args=asked)
        others.start()
        time.sleep(2.0)
        begin = lab.read()
        cpu, wall = read_cpu_seconds(lab.process.pid), time.monotonic()
        found = asyncio.run(measure(lab, rate, seconds))
        cpu = read_cpu_seconds(lab.process.pid) - cpu
        wall = time.monotonic() - wall
        end = lab.read()
        others.join(seconds + 30.0)
        others.kill()
    shown = found[np.isfinite(found)] * 1e3
    p50, p99 = np.percentile(shown, [50, 99])
    print(f"{count} streams of one session, {rate:g} commands/s, {wall:.1f} s")
    print(f"  command to sample    median {p50:.1f}, p99 {p99:.1f}, worst {shown.max():.1f} ms")
    print(f"  commands that showed {len(shown)} of {len(found)}")
    print(
        f"  time given up        {end['accumulated_delay_s'] - begin['accumulated_delay_s']:.3f} s"
    )
    print(f"  server               {cpu / wall * 100:.0f} % of one core")


if __name__ == "__main__":
    main()

"""`python -m tests.benchmarks.sessions [N] [SECONDS] [ARM]`: N sessions, each with a stream.

ARM is the name of an arm; without it each session is Figure 4A.
"""

import asyncio
import os
import sys
import time
from pathlib import Path

from websockets.asyncio.client import connect

from tests.lab import Lab, run_lab

TICKS_PER_SECOND = os.sysconf("SC_CLK_TCK")


async def watch(url: str, seconds: float) -> int:
    """Read a stream for this duration; return the number of bytes."""
    received = 0
    end = time.monotonic() + seconds
    async with connect(url, proxy=None, max_size=None) as stream:
        while time.monotonic() < end:
            received += len(await asyncio.wait_for(stream.recv(), 10))
    return received


async def watch_all(lab: Lab, names: list[str], seconds: float) -> list[int]:
    """One client for every session, all at once."""
    base = lab.url.replace("http", "ws", 1) + "/api/v1/sessions/"
    return await asyncio.gather(*(watch(f"{base}{name}/stream", seconds) for name in names))


def read_cpu_seconds(process: int) -> float:
    """Return user and system time of a process, s."""
    fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / TICKS_PER_SECOND


def main() -> None:
    """Print how many sessions ran in real time, and their cost."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 40
    seconds = float(sys.argv[2]) if len(sys.argv) > 2 else 20.0
    wanted = {"from": "arm", "arm": sys.argv[3]} if len(sys.argv) > 3 else {"figure": "4a"}
    with run_lab() as lab:
        names = []
        for _ in range(count):
            answer = lab.client.post("/api/v1/sessions", json=wanted).raise_for_status()
            names.append(answer.json()["session"])
        begin = {state["session"]: state for state in lab.client.get("/api/v1/sessions").json()}
        cpu, wall = read_cpu_seconds(lab.process.pid), time.monotonic()
        received = asyncio.run(watch_all(lab, names, seconds))
        cpu = read_cpu_seconds(lab.process.pid) - cpu
        wall = time.monotonic() - wall
        states = lab.client.get("/api/v1/sessions").json()
        states = [state for state in states if state["session"] in names]
    delay = max(
        s["accumulated_delay_s"] - begin[s["session"]]["accumulated_delay_s"] for s in states
    )
    print(f"{count} sessions at 1 kHz, {count} streams, {wall:.1f} s")
    print(f"  time given up, worst session   {delay:.3f} s")
    print(f"  real-time factor, worst        {min(s['real_time_factor'] for s in states):.4f}")
    print(f"  a stream                       {max(received) / seconds / 1000:.1f} kB/s")
    print(f"  server                         {cpu / wall * 100:.0f} % of one core")


if __name__ == "__main__":
    main()

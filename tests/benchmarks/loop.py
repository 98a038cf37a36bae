"""How punctual the loop of a bench is, next to a server that streams.

    python -m tests.benchmarks.loop [SECONDS] [CLIENTS] [FIGURE] [LAW]

Runs the emulator against the clock, `svsa serve --bench` on it, the given number of stream clients,
and one of the paper's figures with its load at 5 s. Prints lateness, cost of a tick, skipped ticks,
memory of the loop's process, and whether the run ended in a fault.
"""

import asyncio
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from svsa.hardware.emulator.experiment import EMULATOR_BENCH
from svsa.hardware.emulator.launch import start_emulator
from svsa.runs.definition.paper import CABLE_PULL, get_figure
from tests.benchmarks.sessions import watch
from tests.lab import Lab, run_lab

LOOP = "svsa.hardware.realtime.process"


def write_bench(folder: Path, port: int, control_port: int) -> Path:
    """The rig's bench file with these ports, and its calibration."""
    path = folder / "bench.toml"
    text = EMULATOR_BENCH.read_text(encoding="utf-8")
    text = text.replace("port = 29536", f"port = {port}")
    text = text.replace("control_port = 29537", f"control_port = {control_port}")
    path.write_text(text, encoding="utf-8")
    record = EMULATOR_BENCH.with_name("bench.calibration.toml")
    shutil.copy(record, folder / "bench.calibration.toml")
    return path


def find_loop(server: int) -> int:
    """Return the process of the loop, a child of the server."""
    listed = subprocess.run(
        ["ps", "--ppid", str(server), "-o", "pid=,args="],
        capture_output=True,
        text=True,
        check=True,
    )
    return next(int(line.split()[0]) for line in listed.stdout.splitlines() if LOOP in line)


def read_memory_kb(process: int) -> int:
    """Resident memory of a process, kB."""
    status = Path(f"/proc/{process}/status").read_text().splitlines()
    return next(int(line.split()[1]) for line in status if line.startswith("VmRSS"))


def prepare(lab: Lab, figure: str, law: str) -> None:
    """Arm, home and set the figure after the start of the loop."""
    while lab.read()["bench"]["loop"]["state"] == "starting":
        time.sleep(0.1)
    chosen = get_figure(figure)
    lab.client.put(lab.session + "/law", json={"law": law}).raise_for_status()
    for part in ("position", "stiffness"):
        reference = getattr(chosen, part).model_dump(mode="json")
        lab.client.put(f"{lab.session}/{part}", json=reference).raise_for_status()
    lab.client.post(lab.session + "/bench/arm").raise_for_status()
    while lab.read()["bench"]["status"] != "ready":
        time.sleep(0.1)
    for step in ("link", "motor1", "motor2"):
        body = {"step": step, "by": "tests.benchmarks.loop"}
        lab.client.post(lab.session + "/bench/home", json=body).raise_for_status()


async def run(lab: Lab, seconds: float, clients: int) -> tuple[int, int]:
    """Watch and run; memory of the loop's process after 5 s and at the end, kB."""
    watching = [asyncio.create_task(watch(lab.stream_url, seconds)) for _ in range(clients)]
    await asyncio.sleep(0.5)
    await asyncio.to_thread(lab.client.post, lab.session + "/start")
    load = CABLE_PULL.model_dump(mode="json")
    await asyncio.to_thread(lab.client.post, lab.session + "/loads", json=load)
    await asyncio.sleep(5.0)
    loop = find_loop(lab.process.pid)
    begin = read_memory_kb(loop)
    await asyncio.gather(*watching, return_exceptions=True)
    return begin, read_memory_kb(loop)


def main() -> None:
    """Print the results."""
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 21.0
    clients = int(sys.argv[2]) if len(sys.argv) > 2 else 20
    figure = sys.argv[3] if len(sys.argv) > 3 else "6a"
    law = sys.argv[4] if len(sys.argv) > 4 else "ndobc"
    with (
        tempfile.TemporaryDirectory(prefix="svsa-bench-") as folder,
        start_emulator(lockstep=False) as emulator,
    ):
        path = write_bench(Path(folder), emulator.port, emulator.control_port)
        with run_lab("--bench", str(path)) as lab:
            prepare(lab, figure, law)
            before, after = asyncio.run(run(lab, seconds, clients))
            state = lab.read()
    loop, fault = state["bench"]["loop"], state["fault"]
    late = [1e6 * loop[f"lateness_{name}_s"] for name in ("p50", "p99", "p999", "worst")]
    print(f"figure {figure} {law}, {seconds:g} s, {clients} stream clients")
    print(f"  {'; '.join(loop['notes'])}")
    print(
        "  lateness p50, p99, p99.9, worst  " + ", ".join(f"{value:.0f}" for value in late) + " µs"
    )
    print(f"  cost of a tick, p99              {1e6 * loop['cost_p99_s']:.0f} µs")
    print(f"  ticks, skipped                   {loop['ticks']}, {loop['skipped_ticks']}")
    print(f"  memory of the loop               {before} → {after} kB")
    print(f"  ended at tick {state['tick']}: {fault['message'] if fault else 'no fault'}")


if __name__ == "__main__":
    main()

"""`python -m tests.benchmarks.memory [MINUTES]`: does a session at full speed grow?"""

import gc
import sys
import time
from pathlib import Path

import svsa
from svsa.runs.command import ApplyLoad
from svsa.runs.session.simulated import SimulatedSession
from tests.runs.session.sessions import EVERY_EFFECT

COMPARISONS = (svsa.Lane(law="fl"), svsa.Lane(law="ndobc"), svsa.Lane(law="fl"))
MINUTE_S = 60.0


def read_resident_mb() -> float:
    """Resident memory of this process, MB."""
    gc.collect()
    for line in Path("/proc/self/status").read_text().splitlines():
        if line.startswith("VmRSS:"):
            return int(line.split()[1]) / 1000.0
    raise RuntimeError("no VmRSS in /proc/self/status")


def run_at_full_speed(session: SimulatedSession, seconds: float) -> None:
    """So much session time, in bursts, with a pulse at each burst."""
    end = session.run.time_s + seconds
    pulse = svsa.PulseLoad(torque_nm=(0.2, 0.0, 0.0), duration_s=0.1)
    while session.run.time_s < end:
        session.burst(time.monotonic())
        session.change(ApplyLoad(argument=pulse))
        if session.run.fault is not None:
            raise RuntimeError(session.run.fault.message)


def main() -> None:
    """Print the resident memory after the first minute and after each of the others."""
    minutes = int(sys.argv[1]) if len(sys.argv) > 1 else 10
    configuration = svsa.paper.get_figure("4b").build_configuration(load=False)
    session = SimulatedSession(
        "memory", configuration.changed(comparisons=COMPARISONS, effects=EVERY_EFFECT)
    )
    session.start()
    print(f"start                     {read_resident_mb():8.1f} MB")
    run_at_full_speed(session, MINUTE_S)
    before = read_resident_mb()
    print(f"after minute  1           {before:8.1f} MB")
    begin = time.monotonic()
    for minute in range(2, minutes + 2):
        run_at_full_speed(session, MINUTE_S)
        print(f"after minute {minute:2}           {read_resident_mb():8.1f} MB")
    wall = time.monotonic() - begin
    grown = read_resident_mb() - before
    print(f"growth in {minutes} minutes of session time, 4 lanes, every effect: {grown:.1f} MB")
    kept = len(session.journal.commands)
    print(f"{minutes * MINUTE_S / wall:.0f} times real time, {kept} commands kept")


if __name__ == "__main__":
    main()

"""`python -m tests.benchmarks.memory [SESSIONS]`: resident memory of a server and of its sessions.

Prints the memory of a server at rest, whose code was stored or that has compiled it; of a session
of each kind with a full history; and of SESSIONS sessions, before and after they end.
"""

import sys
import tempfile

from svsa.runs.session.journal import HISTORY_TICKS
from tests.benchmarks.attacks import read_memory_mb
from tests.lab import Lab, run_lab

STEP_TICKS = 8192
EFFECTS = {"encoders": {}, "estimation": {}, "delay_samples": 1}
REPEATS = 4


def open_sessions(
    lab: Lab, count: int, effects: dict | None = None, **options: object
) -> list[str]:
    """Open paused sessions with a full history; return their paths."""
    paths = []
    for _ in range(count):
        opened = lab.client.post("/api/v1/sessions", json=options).raise_for_status()
        paths.append(f"/api/v1/sessions/{opened.json()['session']}")
        lab.client.post(paths[-1] + "/pause").raise_for_status()
        if effects is not None:
            lab.client.put(paths[-1] + "/effects", json=effects).raise_for_status()
        for _ in range(HISTORY_TICKS // STEP_TICKS):
            lab.client.post(paths[-1] + "/step", json={"ticks": STEP_TICKS}).raise_for_status()
    return paths


def end_sessions(lab: Lab, paths: list[str]) -> None:
    for path in paths:
        lab.client.delete(path).raise_for_status()


def measure_session(lab: Lab, with_view: bool = False, **options: object) -> float:
    """Return the memory of one session of a kind, MB, the mean of some; a first one is not counted,
    because imports and loaded code belong to no session.
    """

    def open_some(count: int) -> list[str]:
        paths = open_sessions(lab, count, **options)
        for path in paths if with_view else ():
            lab.client.get(f"/viser/{path.rpartition('/')[2]}/").raise_for_status()
        return paths

    end_sessions(lab, open_some(1))
    before_mb = read_memory_mb(lab)
    paths = open_some(REPEATS)
    cost_mb = (read_memory_mb(lab) - before_mb) / REPEATS
    end_sessions(lab, paths)
    return cost_mb


def main() -> None:
    """Print the table."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 48
    with tempfile.TemporaryDirectory(prefix="svsa-cache-") as cache:
        for title in ("has compiled", "code was stored"):
            with run_lab(cache=cache) as lab:
                open_sessions(lab, 1, law="lqi")
                print(f"server with a session, {title:16} {read_memory_mb(lab):7.1f} MB")
    with run_lab(max_sessions=str(count)) as lab:
        lab.client.post(lab.session + "/pause").raise_for_status()
        print(f"server at rest                         {read_memory_mb(lab):7.1f} MB")
        for title, options in {
            "one lane": {},
            "two lanes": {"comparisons": [{"law": "fl"}]},
            "non-ideal effects": {"effects": EFFECTS},
            "arm, two joints": {"from": "arm", "arm": "rods"},
            "one lane and 3D view": {"with_view": True},
        }.items():
            print(f"a session: {title:27} {measure_session(lab, **options):7.1f} MB", flush=True)
        before_mb = read_memory_mb(lab)
        paths = open_sessions(lab, count)
        print(
            f"{count} sessions                            {read_memory_mb(lab) - before_mb:7.1f} MB"
        )
        end_sessions(lab, paths)
        print(f"after they have ended                  {read_memory_mb(lab) - before_mb:7.1f} MB")


if __name__ == "__main__":
    main()

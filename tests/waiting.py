"""Waiting for another thread or process."""

import time
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import httpx

T = TypeVar("T")
PATIENCE_S = 300.0


def wait_until(
    read: Callable[[], T], describe: Callable[[], object] = str, longest_s: float = PATIENCE_S
) -> T:
    """Return the first true value of `read`; fail with the text of `describe` after the timeout."""
    end = time.monotonic() + longest_s
    while not (found := read()):
        assert time.monotonic() < end, describe()
        time.sleep(0.02)
    return found


def has_ended(job: dict[str, Any]) -> bool:
    """Whether a job, a tuning or a search has ended."""
    return job["status"] not in ("waiting", "running")


def follow(
    client: httpx.Client, path: str, is_there: Callable[[dict[str, Any]], Any] = has_ended
) -> dict[str, Any]:
    """Return the answer of a route once `is_there` accepts it."""
    last: list[dict[str, Any]] = [{}]

    def read() -> bool:
        last[0] = client.get(path).raise_for_status().json()
        return bool(is_there(last[0]))

    wait_until(read, lambda: last[0])
    return last[0]


def follow_recording(client: httpx.Client, path: str) -> dict[str, Any]:
    """Return the entry of a recorded run once its file is complete."""
    return follow(client, path, lambda run: run["state"] != "recording")


def is_running(process: int) -> bool:
    """Whether a process exists; one that its new parent has not waited for has ended."""
    try:
        state = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0]
    except FileNotFoundError:
        return False
    return state != "Z"

"""Waiting for what another thread or process does."""

import time
from collections.abc import Callable
from typing import Any, TypeVar

import httpx

T = TypeVar("T")
PATIENCE_S = 240.0


def wait_until(
    read: Callable[[], T], describe: Callable[[], object] = str, longest_s: float = PATIENCE_S
) -> T:
    """The first true value of `read`; fails with what `describe` returns after so long."""
    end = time.monotonic() + longest_s
    while not (found := read()):
        assert time.monotonic() < end, describe()
        time.sleep(0.02)
    return found


def has_ended(job: dict[str, Any]) -> bool:
    """Whether a job, a tuning or a search is neither waiting nor running."""
    return job["status"] not in ("waiting", "running")


def follow(
    client: httpx.Client, path: str, is_there: Callable[[dict[str, Any]], Any] = has_ended
) -> dict[str, Any]:
    """What a route answers once it `is_there`."""
    last: list[dict[str, Any]] = [{}]

    def read() -> bool:
        last[0] = client.get(path).raise_for_status().json()
        return bool(is_there(last[0]))

    wait_until(read, lambda: last[0])
    return last[0]


def follow_recording(client: httpx.Client, path: str) -> dict[str, Any]:
    """A recorded run's entry once its file is finished."""
    return follow(client, path, lambda run: run["state"] != "recording")

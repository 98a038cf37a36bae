"""`svsa excite`: the identification excitation, played by a running lab, as a script does it."""

import time
from typing import Any

import httpx
from rich.console import Console
from rich.progress import Progress

from svsa.errors import SvsaError
from svsa_server.config import Settings

_POLL_S = 0.2
_ANSWER_S = 30.0


class RemoteError(SvsaError):
    """The lab was not reached, or refused."""


def play_excitation(url: str, session: str, name: str) -> str:
    """Play it, wait until it is recorded, and print the run's id, which is returned.

    Raises `RemoteError` with what the lab says.
    """
    secret = Settings().secret_text
    headers = {"Authorization": f"Bearer {secret}"} if secret else {}
    path = f"/api/v1/sessions/{session}"
    with httpx.Client(base_url=url, headers=headers, timeout=_ANSWER_S, trust_env=False) as client:
        state = _ask(client, "POST", f"{path}/excitation", {"name": name})
        run_id = state["recording"]["run_id"]
        _wait(client, path, state)
        while (run := _ask(client, "GET", f"/api/v1/runs/{run_id}"))["state"] == "recording":
            time.sleep(_POLL_S)
    console = Console(highlight=False, soft_wrap=True)
    console.print(f"Run {run_id}: {run['duration_s']:.1f} s.")
    console.print(f"Next: svsa identify {run_id} --output mine-design.toml")
    return run_id


def _wait(client: httpx.Client, path: str, state: dict[str, Any]) -> None:
    with Progress(console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("Exciting", total=state["excitation"]["duration_s"])
        played = 0.0
        while state["excitation"] is not None:
            played = state["excitation"]["elapsed_s"]
            bar.update(task, completed=played)
            time.sleep(_POLL_S)
            state = _ask(client, "GET", path)
    if state["fault"] is not None:
        raise RemoteError(f"Broken off after {played:.1f} s: {state['fault']['message']}")


def _ask(
    client: httpx.Client, method: str, path: str, body: dict[str, Any] | None = None
) -> dict[str, Any]:
    try:
        answer = client.request(method, path, json=body)
        told = answer.json()
    except (httpx.HTTPError, ValueError) as error:
        raise RemoteError(f"The lab at {client.base_url} does not answer: {error}.") from None
    if answer.is_error:
        raise RemoteError(f"The lab refuses: {told.get('message', answer.status_code)}")
    return told

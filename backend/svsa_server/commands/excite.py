"""`svsa excite`: play the identification excitation on a running lab."""

import time

from rich.console import Console
from rich.progress import Progress

from svsa.client import LabError, RemoteSession, connect
from svsa_server.config import Settings

_POLL_S = 0.2


def play_excitation(url: str, session: str, name: str) -> str:
    """Play the excitation, wait for its record, print the run's id and return it.

    A rejection raises the exception of the library.

    Raises:
        LabError: If it is interrupted.
    """
    with connect(url, Settings().secret_text) as lab:
        excited = lab.open_session(session)
        recording = excited.excite(name)
        _wait(excited)
        recording.stop()
        run = lab.runs.read(recording.run_id)
    console = Console(highlight=False, soft_wrap=True)
    console.print(f"Run {recording.run_id}: {run['duration_s']:.1f} s.")
    console.print(f"Next: svsa identify {recording.run_id} --output mine-design.toml")
    return recording.run_id


def _wait(session: RemoteSession) -> None:
    with Progress(console=Console(stderr=True), transient=True) as bar:
        state = session.read_state()
        played, task = 0.0, bar.add_task("Exciting", total=None)
        while state["excitation"] is not None:
            played = state["excitation"]["elapsed_s"]
            bar.update(task, completed=played, total=state["excitation"]["duration_s"])
            time.sleep(_POLL_S)
            state = session.read_state()
    if state["fault"] is not None:
        raise LabError(f"Interrupted after {played:.1f} s: {state['fault']['message']}")

"""Tunings: searches of minutes, in a process of their own, that anybody follows and breaks off.

The worker writes what it tried into a folder, a line a trial, and looks there whether it is to
stop; so that the server only reads, and a search goes on whoever looks.
"""

import contextlib
import json
import shutil
import tempfile
from asyncio import Task, create_task
from collections import OrderedDict
from pathlib import Path
from typing import Any, Literal, NamedTuple
from uuid import uuid4

from svsa.arena.tune import Trial, tune
from svsa.arena.tuned_file import describe_trial, describe_tuned, format_tuned
from svsa.errors import SvsaError
from svsa.run.configuration import Design
from svsa_server.errors import UnknownError
from svsa_server.heavy_work import BusyError, HeavyWork

MAX_KEPT = 20
TRIALS, RESULT, FILE, STOP = "trials.jsonl", "result.json", "parameters.toml", "stop"

Status = Literal["waiting", "running", "done", "cancelled", "failed"]


class Asked(NamedTuple):
    """What is to be searched."""

    law: str
    budget: int
    seed: int
    held: dict[str, float]
    present: Design


class Tuning:
    """One search. folder: where its worker writes."""

    def __init__(self, name: str, asked: Asked, folder: Path, work: HeavyWork) -> None:
        self.name, self.asked, self.folder = name, asked, folder
        self.problem = ""
        self._task: Task[None] = create_task(self._run(work))

    @property
    def is_under_way(self) -> bool:
        """Whether it is worked at, or waits."""
        return not self._task.done()

    @property
    def status(self) -> Status:
        """Where it stands."""
        if self.is_under_way:
            return "running" if (self.folder / TRIALS).exists() else "waiting"
        if self.problem:
            return "failed"
        tried = len(self.read_trials(0))
        return "done" if tried > self.asked.budget else "cancelled"

    async def _run(self, work: HeavyWork) -> None:
        try:
            await work.run(search, self.asked, self.folder)
        except SvsaError as error:
            self.problem = str(error)

    def read_trials(self, first: int) -> list[dict[str, Any]]:
        """What was tried, from this number on."""
        with contextlib.suppress(FileNotFoundError):
            whole, _, _ = (self.folder / TRIALS).read_text(encoding="utf-8").rpartition("\n")
            return [json.loads(line) for line in whole.splitlines()[first:]]
        return []

    def read_file(self) -> str:
        """The parameter file of the best, once it has ended."""
        return (self.folder / FILE).read_text(encoding="utf-8")

    def stop(self) -> None:
        """Let it end before its next candidate; the best so far is kept."""
        (self.folder / STOP).touch()


class Tunings:
    """The searches of one server, the last ones kept, one at a time worked at.

    most: how many are worked at or wait; one more is refused.
    """

    def __init__(self, most: int) -> None:
        self._work = HeavyWork(most, workers=1)
        self._most = most
        self._kept: OrderedDict[str, Tuning] = OrderedDict()
        self._place = tempfile.TemporaryDirectory(prefix="svsa-", ignore_cleanup_errors=True)

    def start(self, asked: Asked) -> Tuning:
        """Begin a search, or queue it; raises `BusyError`."""
        under_way = sum(tuning.is_under_way for tuning in self._kept.values())
        if under_way >= self._most:
            raise BusyError(
                f"{under_way} tunings are worked at or wait, which is all this lab takes at once:"
                " stop one, or try again later."
            )
        name = uuid4().hex[:12]
        folder = Path(self._place.name) / name
        folder.mkdir()
        self._kept[name] = Tuning(name, asked, folder, self._work)
        ended = [name for name, tuning in self._kept.items() if not tuning.is_under_way]
        for old in ended[: max(0, len(self._kept) - MAX_KEPT)]:
            shutil.rmtree(self._kept.pop(old).folder, ignore_errors=True)
        return self._kept[name]

    def get(self, name: str) -> Tuning:
        """The search of this name; raises `UnknownError`."""
        if name not in self._kept:
            raise UnknownError(f"There is no tuning {name} here: it may be of an earlier start.")
        return self._kept[name]

    def list_all(self) -> list[Tuning]:
        """Those that are kept, the newest first."""
        return list(reversed(self._kept.values()))

    def close(self) -> None:
        """End the searches, and take away what they have written."""
        self._work.close()
        self._place.cleanup()


def search(asked: Asked, folder: Path) -> None:
    """Tune in a worker: a line a trial, and the result and its file at the end."""
    with (folder / TRIALS).open("w", encoding="utf-8", buffering=1) as lines:

        def note(trial: Trial) -> None:
            lines.write(json.dumps(describe_trial(trial)) + "\n")

        tuned = tune(
            asked.law,
            budget=asked.budget,
            seed=asked.seed,
            held=asked.held,
            present=asked.present,
            on_trial=note,
            is_cancelled=(folder / STOP).exists,
        )
    (folder / FILE).write_text(format_tuned(tuned), encoding="utf-8")
    (folder / RESULT).write_text(json.dumps(describe_tuned(tuned)), encoding="utf-8")

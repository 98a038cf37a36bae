"""A tuning as a job: its worker writes what it tried a line a trial, and a file at the end."""

import contextlib
import json
from pathlib import Path
from typing import Any, NamedTuple

from svsa.evaluation.tuning.file import describe_trial, format_tuned
from svsa.evaluation.tuning.tuner import Trial, tune
from svsa.runs.configuration import Design
from svsa_server.jobs.progress import JobFolder

_TRIALS, _FILE = "trials.jsonl", "parameters.toml"


class Asked(NamedTuple):
    """What is to be searched."""

    law: str
    budget: int
    seed: int
    held: dict[str, float]
    present: Design


def search(folder: JobFolder, asked: Asked) -> bool:
    """Tune a law in a worker; whether the budget was used up."""
    with (folder.path / _TRIALS).open("w", encoding="utf-8", buffering=1) as lines:

        def note(trial: Trial) -> None:
            lines.write(json.dumps(describe_trial(trial)) + "\n")
            folder.report(trial.number + 1, asked.budget + 1)

        tuned = tune(
            asked.law,
            budget=asked.budget,
            seed=asked.seed,
            held=asked.held,
            present=asked.present,
            on_trial=note,
            is_cancelled=folder.is_cancelled,
        )
    (folder.path / _FILE).write_text(format_tuned(tuned), encoding="utf-8")
    return tuned.is_complete


def read_trials(folder: Path) -> list[dict[str, Any]]:
    """What was tried so far."""
    with contextlib.suppress(FileNotFoundError):
        whole, _, _ = (folder / _TRIALS).read_text(encoding="utf-8").rpartition("\n")
        return [json.loads(line) for line in whole.splitlines()]
    return []


def read_file(folder: Path) -> str | None:
    """The parameter file of the best, once the search has ended with one."""
    with contextlib.suppress(FileNotFoundError):
        return (folder / _FILE).read_text(encoding="utf-8")
    return None

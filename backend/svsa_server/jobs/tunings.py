"""A tuning as a job: the worker writes a line for each candidate, and a file at the end."""

from pathlib import Path
from typing import Any, NamedTuple

from svsa.evaluation.campaign.journal import Journal, define_search, read_lines
from svsa.evaluation.tuning.file import format_tuned
from svsa.evaluation.tuning.tuner import tune
from svsa.runs.definition.design import Design
from svsa_server.jobs.progress import JobFolder

_CANDIDATES, _FILE = "candidates.jsonl", "parameters.toml"


class Task(NamedTuple):
    """The settings of a search."""

    law: str
    budget: int
    seed: int
    held: dict[str, float]
    present: Design


def search(folder: JobFolder, task: Task) -> bool:
    """Tune a law in a worker; return whether the budget was used up."""
    tuned = tune(
        task.law,
        budget=task.budget,
        seed=task.seed,
        held=task.held,
        present=task.present,
        on_candidate=lambda tried: folder.report(tried.number + 1, task.budget + 1),
        is_cancelled=folder.is_cancelled,
        journal=Journal(folder.path / _CANDIDATES, define_search(task.law)),
    )
    (folder.path / _FILE).write_text(format_tuned(tuned), encoding="utf-8")
    return tuned.is_complete


def read_candidates(folder: Path) -> list[dict[str, Any]]:
    """Read the candidates so far, and those on the validation trials."""
    return [line for line in read_lines(folder / _CANDIDATES) if "stage" in line]


def find_file(folder: Path) -> Path | None:
    """Find the parameter file of the best candidate, once the search has ended with one."""
    path = folder / _FILE
    return path if path.exists() else None

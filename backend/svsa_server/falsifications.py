"""The falsifier as a job: its worker writes the worst so far, and the scenario at the end."""

import contextlib
import json
import math
from pathlib import Path
from typing import Any, NamedTuple

from svsa.control.installed import BASELINE, PAPERS_LAW
from svsa.falsify.adversary import Adversary
from svsa.falsify.file import format_scenario, read_scenario
from svsa.falsify.find import falsify
from svsa.falsify.measure import run_scenario
from svsa.falsify.scenario import LoadScenario
from svsa.falsify.wording import tell_severity
from svsa.records.header import replace_file
from svsa.study.tables import make_plain
from svsa_server.job_progress import JobFolder

_WORST, _OUTCOMES, _SCENARIO = "worst.txt", "outcomes.json", "scenario.toml"


class Asked(NamedTuple):
    """What is to be searched."""

    adversary: Adversary
    runs: int
    seed: int


def search(folder: JobFolder, asked: Asked) -> bool:
    """Search in a worker, and put the law and another one through what was found; whether all of
    the search was done.
    """

    def tell(done: int, worst: float) -> None:
        folder.tell(done, asked.runs)
        told = tell_severity(asked.adversary.harm, worst) if math.isfinite(worst) else "a fault"
        replace_file(folder.path / _WORST, told.encode())

    found = falsify(
        asked.adversary,
        runs=asked.runs,
        seed=asked.seed,
        on_generation=tell,
        is_cancelled=folder.is_cancelled,
    )
    compared = run_scenario(found.scenario, list_beside(asked.adversary.law))
    outcomes = make_plain([one._asdict() for one in compared])
    (folder.path / _OUTCOMES).write_text(json.dumps(outcomes), encoding="utf-8")
    (folder.path / _SCENARIO).write_text(format_scenario(found.scenario), encoding="utf-8")
    return found.is_complete


def list_beside(law: str) -> tuple[str, str]:
    """A law, and NDOBC beside it; beside NDOBC what the paper compares it with."""
    return law, BASELINE if law == PAPERS_LAW else PAPERS_LAW


def read_worst(folder: Path) -> str | None:
    """How much the worst run hurts so far, in words."""
    with contextlib.suppress(FileNotFoundError):
        return (folder / _WORST).read_text(encoding="utf-8")
    return None


def find_file(folder: Path) -> Path | None:
    """The file of the scenario, once the search has ended with one."""
    path = folder / _SCENARIO
    return path if path.exists() else None


def read_found(folder: Path) -> tuple[LoadScenario, list[dict[str, Any]]] | None:
    """The scenario, and what came of each law in it, once the search has ended."""
    path = find_file(folder)
    if path is None:
        return None
    return read_scenario(path), json.loads((folder / _OUTCOMES).read_text(encoding="utf-8"))

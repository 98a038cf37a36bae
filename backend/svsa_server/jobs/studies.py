"""A study as a job, and computations of a worker on its rows."""

from typing import Any

from svsa.evaluation.studies.execution import run_study
from svsa.evaluation.studies.replay import record_replay, replay_row
from svsa.evaluation.studies.rows import read_rows
from svsa.evaluation.studies.stored import StoredStudy
from svsa.evaluation.studies.summary import (
    compare_laws,
    estimate_sensitivity,
    summarize_actuators,
    summarize_laws,
)
from svsa.evaluation.studies.tables import make_plain
from svsa.runs.records.catalogue.runs import Catalogue
from svsa_server.jobs.heavy_work import MAX_WORKERS
from svsa_server.jobs.progress import JobFolder

ROWS_PER_PART = 256
MAX_ROWS = 10**7


def run(folder: JobFolder, stored: StoredStudy) -> bool:
    """Run the missing part of a study; return whether the study is complete."""
    return run_study(
        stored,
        workers=MAX_WORKERS if MAX_WORKERS > 1 else 0,
        rows_per_part=ROWS_PER_PART,
        progress=folder.report,
        is_cancelled=folder.is_cancelled,
    )


def summarize(stored: StoredStudy) -> dict[str, Any]:
    """Summarize every law of a study, and the first law's difference from each other one, as
    JSON.
    """
    study, rows = stored.study, read_rows(stored)
    laws, pairings = summarize_laws(study, rows), compare_laws(study, rows)
    actuators = summarize_actuators(study, rows)
    return make_plain({"laws": laws, "actuators": actuators, "pairings": pairings})


def decide(stored: StoredStudy, outcome: str) -> list[dict[str, Any]]:
    """Compute Sobol indices of an outcome under each law, as JSON."""
    study, rows = stored.study, read_rows(stored)
    return make_plain([estimate_sensitivity(study, rows, law, outcome) for law in study.laws])


def replay(stored: StoredStudy, row: int, owner: str) -> dict[str, Any]:
    """Run a row again and record it; return the run's id, and whether its metrics match the
    table.
    """
    replayed = replay_row(stored, row)
    run_id = record_replay(stored, replayed, Catalogue(), owner).id
    return {"run_id": run_id, "row": row, "differing": replayed.differing}

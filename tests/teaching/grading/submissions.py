"""Submissions with their runs and laws, as students would submit them."""

import json
from pathlib import Path

import svsa
from svsa.runs.records.catalogue.runs import Catalogue
from svsa.runs.records.writer import write_record
from svsa.teaching.course.steps import Experiment
from tests.runs.records.records import build_header
from tests.teaching.course.runs import find_exercise, simulate_step

EXERCISE = "feedback-linearization"
LAW_EXERCISE = """+++
number = 90
title = "A law of your own"
goal = "Write one."

[[steps]]
name = "submit"
kind = "submit"
title = "Hand it in"
law = true
+++
Write a law.

## submit

Your file goes in.
"""
LAZY = b"def law(*given): return 0.0, 0.0\n"
GOOD = b"""
from svsa.actuators.linearization import compute_linearization, solve_decoupling

def build(model):
    integral = 0.0
    def law(time_s, reference, x, w):
        nonlocal integral
        now, a = compute_linearization(model, x), 45.0
        error = (reference.q - now.q, reference.dq - now.dq, reference.ddq - now.ddq,
                 reference.dddq - now.dddq)
        integral += 0.001 * error[0]
        gains = (5 * a**4, 10 * a**3, 10 * a**2, 5 * a)
        y1 = reference.ddddq - now.ddddq + sum(g * e for g, e in zip(gains, error))
        y2 = (reference.ddsigma - now.ddsigma + 1600.0 * (reference.sigma - now.sigma)
              + 80.0 * (reference.dsigma - now.dsigma))
        return tuple(solve_decoupling(now, y1 + a**5 * integral, y2))
    return law
"""


def write_course(folder: Path) -> Path:
    folder.mkdir(exist_ok=True)
    (folder / "own-law.md").write_text(LAW_EXERCISE)
    return folder


def submit_law(folder: Path, law: bytes, student: str = "Ada", **changes: object) -> Path:
    folder.mkdir(exist_ok=True)
    (folder / "law.py").write_bytes(law)
    reported = {"student": student, "exercise": "own-law", "law_file": "law.py"} | changes
    path = folder / "submission.json"
    path.write_text(json.dumps(reported))
    return path


def record_step(catalogue: Catalogue, step: str, flip: bool = False) -> str:
    """Record the run of a step; with flip, one bit of one sample is changed."""
    setup = find_exercise(EXERCISE).find_step(step)
    assert isinstance(setup, Experiment)
    result = simulate_step(EXERCISE, step)
    samples = result.samples[:, None, :].copy()
    if flip:
        samples.view("uint64")[7000, 0, 4] ^= 1
    run_id = f"run-{step}{'-flipped' if flip else ''}"
    header = build_header(
        run_id,
        lanes=(result.law,),
        configuration=setup.configuration.model_dump(mode="json"),
        seed=setup.configuration.seed,
        version=svsa.__version__,
    )
    write_record(catalogue.folder / "runs" / run_id, header, [], 0, samples)
    catalogue.register(header)
    catalogue.finish(run_id)
    return run_id

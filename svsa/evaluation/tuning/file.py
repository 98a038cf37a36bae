"""What a search found, as a parameter file that says what it was measured on, and as JSON."""

from typing import Any

import numpy
import scipy

from svsa.control.installed import has_own_parameters
from svsa.evaluation.tuning.tuner import Trial, Tuned
from svsa.inputs.extras import __version__
from svsa.runs.configuration import format_design

_NOT_TUNED = "as before the tuning"


def format_tuned(tuned: Tuned) -> str:
    """The text of a parameter file (TOML): the law's numbers with their source, the rest as it was.

    What they were measured on stands above, in comments.
    """
    law = tuned.space.law
    sections = {f"parameters.{law}"} if has_own_parameters(law) else {"gains", "observer"}
    source = describe_search(tuned)
    text = format_design(tuned.design, lambda name: source if name in sections else _NOT_TUNED)
    head = [f"# {source}", *(f"#   {line}" for line in _describe_runs(tuned))]
    return "\n".join(head) + "\n\n" + text


def describe_search(tuned: Tuned) -> str:
    """The search in a line: law, budget, seed, cost before and after, versions."""
    tried = len(tuned.trials) - 1
    share = f"{tried} candidates" if tuned.is_complete else f"{tried} of {tuned.budget} candidates"
    held = ", ".join(f"{name} = {value:g}" for name, value in tuned.space.held.items())
    return (
        f"svsa tune {tuned.space.law}{f' with {held}' if held else ''}: cost {tuned.best.cost:.4g}"
        f" (before {tuned.start.cost:.4g}), {share}, seed {tuned.seed},"
        f" {len(tuned.runs)} training runs of {tuned.duration_s:g} s,"
        f" svsa {__version__}, numpy {numpy.__version__}, scipy {scipy.__version__}"
    )


def describe_tuned(tuned: Tuned) -> dict[str, Any]:
    """What a search found, as JSON: axes, trials and the design's part that belongs to the law."""
    return {
        "law": tuned.space.law,
        "budget": tuned.budget,
        "seed": tuned.seed,
        "is_complete": tuned.is_complete,
        "source": describe_search(tuned),
        "runs": [{"name": run.name, "title": run.title} for run in tuned.runs],
        "duration_s": tuned.duration_s,
        "axes": [
            {"name": axis.label, "symbol": axis.symbol, "unit": axis.unit, "low": axis.low}
            | {"high": axis.high}
            for axis in tuned.space.axes
        ],
        "held": tuned.space.held,
        "present": describe_trial(tuned.start),
        "best": describe_trial(tuned.best),
        "trials": [describe_trial(trial) for trial in tuned.trials],
    }


def describe_trial(trial: Trial) -> dict[str, Any]:
    """A trial as JSON."""
    return {
        "number": trial.number,
        "stage": trial.stage,
        "values": list(trial.values),
        "cost": trial.cost,
        "runs": [run._asdict() | {"fault": run.fault or None} for run in trial.runs],
    }


def _describe_runs(tuned: Tuned) -> list[str]:
    rows = zip(tuned.runs, tuned.start.runs, tuned.best.runs, strict=True)
    return [f"{run.name}: {run.title}: {old.cost:.4g} → {new.cost:.4g}" for run, old, new in rows]

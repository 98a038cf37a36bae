"""Results of a search as parameter file, JSON and checkpoint."""

from pathlib import Path
from typing import Any

import numpy
import scipy

from svsa.control.installed import has_own_parameters
from svsa.evaluation.tuning.judge import Judgment
from svsa.evaluation.tuning.tuner import Candidate, Tuned
from svsa.inputs.extras import __version__
from svsa.inputs.nesting import load_json
from svsa.runs.design_file import format_design

_NOT_TUNED = "as before the tuning"


def format_tuned(tuned: Tuned) -> str:
    """The text of a parameter file (TOML): the law's numbers with their source."""
    law = tuned.space.law
    sections = {f"parameters.{law}"} if has_own_parameters(law) else {"gains", "observer"}
    source = describe_search(tuned)
    text = format_design(tuned.design, lambda name: source if name in sections else _NOT_TUNED)
    return f"# {source}\n\n{text}"


def describe_search(tuned: Tuned) -> str:
    """Describe the search in a line: law, budget, trials, seed, costs, versions."""
    tried = len(tuned.candidates) - 1
    share = f"{tried} candidates" if tuned.is_complete else f"{tried} of {tuned.budget} candidates"
    held = ", ".join(f"{name} = {value:g}" for name, value in tuned.space.held.items())
    before = tuned.finals[0] if tuned.finals else tuned.start
    return (
        f"svsa tune {tuned.space.law}{f' with {held}' if held else ''}:"
        f" cost {tuned.best.judgment.cost:.4g} (before {before.judgment.cost:.4g}), {share} on"
        f" {tuned.trials} training trials, {tuned.validation} validation trials,"
        f" seed {tuned.seed}, svsa {__version__}, numpy {numpy.__version__},"
        f" scipy {scipy.__version__}"
    )


def describe_tuned(tuned: Tuned) -> dict[str, Any]:
    """Convert the result of a search to JSON."""
    return {
        "law": tuned.space.law,
        "budget": tuned.budget,
        "trials": tuned.trials,
        "validation": tuned.validation,
        "seed": tuned.seed,
        "is_complete": tuned.is_complete,
        "source": describe_search(tuned),
        "axes": [
            {"name": axis.label, "symbol": axis.symbol, "unit": axis.unit, "low": axis.low}
            | {"high": axis.high}
            for axis in tuned.space.axes
        ],
        "held": tuned.space.held,
        "present": describe_candidate(tuned.start),
        "best": describe_candidate(tuned.best),
        "candidates": [describe_candidate(candidate) for candidate in tuned.candidates],
        "finals": [describe_candidate(candidate) for candidate in tuned.finals],
    }


def describe_candidate(candidate: Candidate) -> dict[str, Any]:
    """Convert a candidate to JSON; infinite values, as after a fault, are None."""
    judged = {
        name: None if value is not None and abs(value) == float("inf") else value
        for name, value in candidate.judgment._asdict().items()
    }
    values = list(candidate.values)
    return {"number": candidate.number, "stage": candidate.stage, "values": values} | judged


def read_checkpoint(path: Path) -> list[Candidate]:
    """Read the candidates before validation, one per line, without an incomplete last line."""
    if not path.exists():
        return []
    whole, _, _ = path.read_text(encoding="utf-8").rpartition("\n")
    read = [_read_candidate(load_json(line)) for line in whole.splitlines()]
    return [candidate for candidate in read if candidate.stage != "validation"]


def _read_candidate(written: dict[str, Any]) -> Candidate:
    number, stage, values = (written.pop(name) for name in ("number", "stage", "values"))
    if written["torque_variation_nm_per_s"] is None:
        written["torque_variation_nm_per_s"] = float("inf")
    return Candidate(number, stage, tuple(values), Judgment(**written))

"""Results of a search as parameter file and JSON."""

from typing import Any

import numpy
import scipy

from svsa.control.installed import has_own_parameters
from svsa.evaluation.tuning.tuner import Tuned, describe_candidate
from svsa.inputs.extras import __version__
from svsa.runs.definition.design_file import format_design

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

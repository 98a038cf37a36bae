"""A search that was broken off, in a file beside what it writes, so that it goes on."""

import json
from pathlib import Path
from typing import Any

import numpy as np

from svsa.evaluation.falsifier.adversary import Adversary
from svsa.evaluation.falsifier.find import Falsified
from svsa.evaluation.falsifier.search import Method
from svsa.inputs.extras import __version__
from svsa.runs.records.header import replace_file

SUFFIX = ".search"


def keep_search(path: Path, found: Falsified) -> Path:
    """Keep what a search has run that writes to `path`; the file where it is."""
    kept_path = path.with_name(path.name + SUFFIX)
    reported = _describe(found.adversary, found.seed, found.method)
    content = reported | {"severities": [_write(value) for value in found.severities.tolist()]}
    replace_file(kept_path, json.dumps(content).encode())
    return kept_path


def read_search(path: Path, adversary: Adversary, seed: int, method: Method) -> np.ndarray:
    """What was run of the same search; nothing where there is none, or another one."""
    kept_path = path.with_name(path.name + SUFFIX)
    try:
        kept = json.loads(kept_path.read_text(encoding="utf-8"))
        severities = kept.pop("severities")
    except (OSError, ValueError, KeyError, AttributeError):
        return np.empty(0)
    same = kept == json.loads(json.dumps(_describe(adversary, seed, method)))
    return np.array([_read(value) for value in severities]) if same else np.empty(0)


def forget_search(path: Path) -> None:
    """Delete what was kept of a search that is done."""
    path.with_name(path.name + SUFFIX).unlink(missing_ok=True)


def _describe(adversary: Adversary, seed: int, method: Method) -> dict[str, Any]:
    reported: dict[str, Any] = {"version": __version__, "seed": seed, "method": method}
    return reported | {"adversary": adversary.model_dump(mode="json")}


def _write(value: float) -> float | str:
    return value if np.isfinite(value) else repr(value)


def _read(value: float | str) -> float:
    return float(value)

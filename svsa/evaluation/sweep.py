"""A sweep: the same run for every combination of some settings, in threads."""

import itertools
import os
from collections.abc import Iterable, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import fields
from pathlib import Path
from typing import TYPE_CHECKING, Any, Unpack

from svsa.errors import ParameterError, Violation
from svsa.evaluation.studies.setting import change_settings
from svsa.inputs.checked import Checked, check_number
from svsa.inputs.extras import require_extra
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.design import Design
from svsa.runs.definition.experiment import build_experiment
from svsa.runs.definition.paper import DURATION_S
from svsa.runs.definition.run_checks import check_laws
from svsa.runs.definition.shorthand import LawChoice, Settings
from svsa.runs.metrics.metrics import Metrics
from svsa.runs.result.progress import Follow, follow_progress
from svsa.runs.result.simulate import simulate
from svsa.simulation.loop.stepwise import Controller

if TYPE_CHECKING:
    import pandas

MAX_RUNS = 1_000_000
MAX_THREADS = 256
LAW, SEED, FAULT = "law", "seed", "fault"
_METRICS = [field.name for field in fields(Metrics)]


def sweep(
    experiment: str | Configuration,
    vary: Mapping[str, Iterable[Any]],
    *,
    law: LawChoice | Controller | None = None,
    parameters: Design | Path | str | None = None,
    duration_s: float = DURATION_S,
    measure_from_s: float = 0.0,
    threads: int | None = None,
    progress: Follow | None = None,
    **changes: Unpack[Settings],
) -> "pandas.DataFrame":
    """Simulate every combination of settings and return a row of metrics for each.

        svsa.sweep("4a", {"law": ["fl", "ndobc"], "stiffness.stiffness_nm_per_rad": [15, 60]})

    The compiled loop does not hold the GIL, so the runs use all cores. Runs of a law in plain
    Python hold it, and are simulated one after the other.

    Args:
        experiment: A figure of the paper ("4a", "4b", "5") or a `Configuration`.
        vary: Values by setting: "law", "seed", a field of the configuration ("effects"), or a path
            to a value in one ("actuator.link_inertia_kg_m2", "loads[0].torque_nm[1]").
        law: Law of all runs if `vary` has none: a name, or a function as for `simulate`.
        parameters: A parameter file or its `Design`, instead of the experiment's own.
        duration_s: Duration of each run, s.
        measure_from_s: Start of the window of the metrics, s.
        threads: Number of threads; by default one per core.
        progress: Called with the finished share, 0 to 1; without it, a sweep of more than a second
            shows a bar if standard error is a terminal.
        **changes: Fields of the configuration for all runs, as for `simulate`.

    Returns:
        A frame in the order of `itertools.product`: a column for each setting of `vary`, `fault`
        (its code; missing without one), and those of `Metrics`. Metrics of a run that ended before
        `measure_from_s` are missing.

    Raises:
        ParameterError: If a setting does not exist or a value is out of range; nothing is
            simulated.
        MissingExtraError: If pandas, of the extra of that name, is not installed.
    """
    require_extra("pandas")
    import pandas  # imported here: the import takes 0.5 s

    named = {} if law is None or callable(law) else {"law": law}
    configuration = build_experiment(experiment, parameters, {**changes, **named}, sweep)
    cases = [
        dict(zip(vary, values, strict=True))
        for values in itertools.product(*(_list_values(name, vary[name]) for name in vary))
    ]
    if len(cases) > MAX_RUNS:
        raise ParameterError(Violation("vary", len(cases), "runs", f"at most {MAX_RUNS} runs"))
    check_number("measure_from_s", measure_from_s, "s", 0.0, duration_s)
    if threads is not None:
        check_number("threads", threads, "", 1, MAX_THREADS)
    configurations = [_change(configuration, case) for case in cases]
    laws = [case.get(LAW, law) for case in cases]
    own: list[Any] = [case_law if callable(case_law) else None for case_law in laws]

    def run(number: int) -> dict[str, Any]:
        changed = configurations[number]
        result = simulate(changed, own[number], duration_s=duration_s)
        fault = result.fault.code if result.fault else None
        end_s = len(result.samples) * changed.sampling.period_s
        is_measured = end_s > measure_from_s
        metrics = result.measure(measure_from_s, end_s).to_dict() if is_measured else {}
        return {**cases[number], FAULT: fault, **metrics}

    rows: list[dict[str, Any]] = []
    pool = ThreadPoolExecutor(1 if any(own) else threads or os.cpu_count() or 1)
    try:
        with follow_progress("Simulating", progress) as follow:
            for row in pool.map(run, range(len(cases))):
                rows.append(row)
                follow(len(rows) / len(cases))
    finally:
        pool.shutdown(cancel_futures=True)
    # A metric that is not defined is None; in a column of numbers it is NaN.
    frame = pandas.DataFrame(rows, columns=[*vary, FAULT, *_METRICS])
    return frame.astype(dict.fromkeys(_METRICS, float))


def _list_values(name: str, values: Any) -> list[Any]:
    """List the values of a setting.

    Raises:
        ParameterError: Unless it is a non-empty list.
    """
    is_listed = not isinstance(values, str | Mapping | Checked) and isinstance(values, Iterable)
    listed = list(values) if is_listed else []
    if not listed:
        raise ParameterError(Violation(f"vary[{name!r}]", values, "", "a list of values"))
    return listed


def _change(configuration: Configuration, case: Mapping[str, Any]) -> Configuration:
    """Build the configuration of one case, without a law in plain Python."""
    plain = {name: case[name] for name in (LAW, SEED) if name in case}
    if callable(plain.get(LAW)):
        del plain[LAW]
    paths = {name: value for name, value in case.items() if name not in (LAW, SEED)}
    try:
        changed = change_settings(configuration.changed(**plain), paths)
        check_laws(changed)
    except ParameterError as error:
        raise error.within("vary") from None
    return changed

"""A stretch of a study's draws, run under every law: the rows of its table."""

from typing import Any

import numpy as np
import pyarrow as pa

from svsa.run.batch import run_configurations
from svsa.study.draws import Draws, build_configurations, draw
from svsa.study.metrics import METRICS, build_outcome, build_refused
from svsa.study.study import Study

ROW, DRAW, LAW, SEED = "row", "draw", "law", "seed"


def build_schema(study: Study) -> pa.Schema:
    """The columns of a study's table: one row a run.

    row: the run's number, by draw and then by law. fault_tick: null without a fault.
    """
    varied = [
        (variation.column, pa.float64() if variation.is_numeric else pa.string())
        for variation in study.vary
    ]
    outcome = [("succeeded", pa.bool_()), ("fault", pa.string()), ("fault_tick", pa.int64())]
    return pa.schema(
        [
            (ROW, pa.int64()),
            (DRAW, pa.int64()),
            (LAW, pa.string()),
            (SEED, pa.int64()),
            *varied,
            *outcome,
            *((name, pa.float64()) for name in METRICS),
        ]
    )


def run_draws(study: Study, first: int, count: int) -> pa.Table:
    """The rows of the draws `first` to `first + count − 1`."""
    draws, schema = draw(study, first, count), build_schema(study)
    tables = [_run_law(study, draws, number, schema) for number in range(len(study.laws))]
    return pa.concat_tables(tables).sort_by(ROW).combine_chunks()


def _run_law(study: Study, draws: Draws, number: int, schema: pa.Schema) -> pa.Table:
    """The rows of one of the study's laws."""
    law = study.laws[number]
    configurations = build_configurations(study, law, draws)
    run = [index for index, built in enumerate(configurations) if built is not None]
    built = [one for one in configurations if one is not None]
    outcome = build_refused(draws.size)
    if built:
        periods = np.array([one.sampling.period_s for one in built])
        summaries = run_configurations(built, study.duration_s, study.measure_from_s)
        found = build_outcome(summaries, periods, study.measure_from_s, study.success)
        outcome = found if len(built) == draws.size else _fill_in(outcome, run, found)
    numbers = np.arange(draws.first, draws.first + draws.size)
    values = {
        variation.column: variation.label(drawn)
        for variation, drawn in zip(study.vary, draws.values, strict=True)
    }
    columns: dict[str, Any] = {
        ROW: numbers * len(study.laws) + number,
        DRAW: numbers,
        LAW: [law] * draws.size,
        SEED: draws.seeds,
        **values,
        **outcome,
    }
    arrays = [pa.array(columns[field.name], field.type) for field in schema]
    return pa.table(arrays, schema=schema)


def _fill_in(outcome: dict[str, Any], rows: list[int], found: dict[str, Any]) -> dict[str, Any]:
    """The outcome with what was found of some rows in their places."""
    filled: dict[str, Any] = {}
    for name, values in outcome.items():
        filled[name] = np.array(values, dtype=object) if isinstance(values, list) else values
        filled[name][rows] = found[name]
    return filled

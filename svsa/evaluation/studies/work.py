"""Rows of a study's table: a span of samples, run under every law."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from svsa.actuators.domain import build_domain
from svsa.errors import ParameterError
from svsa.evaluation.studies.outcome import Success, build_outcome, build_refused
from svsa.evaluation.studies.samples import ParameterSamples, build_configurations, draw
from svsa.evaluation.studies.study import Study
from svsa.inputs import arrow as pa
from svsa.runs.definition.configuration import Configuration
from svsa.runs.execution.batch import run_configurations

ROW, DRAW, LAW, SEED = "row", "draw", "law", "seed"


def build_schema(study: Study) -> pa.Schema:
    """Build the columns of a study's table: one row per run.

    `row` is the run's number, by sample and then by law; `fault_tick` is null without a fault.
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
            *((name, pa.float64()) for name in study.metrics),
        ]
    )


def list_repeating(schema: pa.Schema) -> Any:  # pyarrow's stubs declare bool; it accepts names
    """List the columns that Parquet stores as a dictionary: names, but no numbers.

    For numbers, looking up existing values would take most of the writing time.
    """
    return [field.name for field in schema if pa.types.is_string(field.type)]


def run_part(study: Study, first: int, count: int) -> bytes:
    """Compute the rows of the samples `first` to `first + count − 1` as a Parquet file."""
    sink = pa.BufferOutputStream()
    rows = run_trials(study, first, count)
    pa.parquet.write_table(rows, sink, use_dictionary=list_repeating(rows.schema))
    return sink.getvalue().to_pybytes()


def run_trials(study: Study, first: int, count: int) -> pa.Table:
    """Compute the rows of the samples `first` to `first + count − 1`."""
    samples, schema = draw(study, first, count), build_schema(study)
    tables = [_run_law(study, samples, number, schema) for number in range(len(study.laws))]
    return pa.concat_tables(tables).sort_by(ROW).combine_chunks()


def _run_law(study: Study, samples: ParameterSamples, number: int, schema: pa.Schema) -> pa.Table:
    """Compute the rows of one law."""
    law = study.laws[number]
    outcome = measure_runs(
        build_configurations(study, law, samples),
        study.duration_s,
        study.measure_from_s,
        study.success,
    )
    numbers = np.arange(samples.first, samples.first + samples.size)
    values = {
        variation.column: variation.label(drawn)
        for variation, drawn in zip(study.vary, samples.values, strict=True)
    }
    columns: dict[str, Any] = {
        ROW: numbers * len(study.laws) + number,
        DRAW: numbers,
        LAW: [law] * samples.size,
        SEED: samples.seeds,
        **values,
        **outcome,
    }
    arrays = [pa.array(columns[field.name], field.type) for field in schema]
    return pa.table(arrays, schema=schema)


def measure_runs(
    configurations: Sequence[Configuration | None],
    duration_s: float,
    measure_from_s: float,
    success: Success,
) -> dict[str, Any]:
    """Compute the outcome of each run, see `build_outcome`; None: rejected settings.

    An actuator whose energy does not have the stiffness range of its limits is rejected, too.
    """
    run = [
        index
        for index, configuration in enumerate(configurations)
        if configuration and _has_domain(configuration)
    ]
    built = [configuration for index in run if (configuration := configurations[index]) is not None]
    outcome = build_refused(len(configurations))
    if not built:
        return outcome
    periods = np.array([configuration.sampling.period_s for configuration in built])
    summaries = run_configurations(built, duration_s, measure_from_s)
    run_outcome = build_outcome(summaries, periods, measure_from_s, success)
    return run_outcome if len(built) == len(configurations) else _fill_in(outcome, run, run_outcome)


def _has_domain(configuration: Configuration) -> bool:
    """Whether the energy of a sampled actuator reaches both ends of the stiffness range."""
    try:
        build_domain(configuration.actuator, configuration.limits)
    except ParameterError:
        return False
    return True


def _fill_in(
    outcome: dict[str, Any], rows: list[int], run_outcome: dict[str, Any]
) -> dict[str, Any]:
    """Insert the outcomes of some rows at their positions."""
    filled: dict[str, Any] = {}
    for name, values in outcome.items():
        filled[name] = np.array(values, dtype=object) if isinstance(values, list) else values
        filled[name][rows] = run_outcome[name]
    return filled

"""Recorded runs in a script: list them, open one, simulate it again, export it."""

import warnings
from pathlib import Path

from svsa.actuators.signals import CHANNEL_NAMES
from svsa.errors import ParameterError
from svsa.runs.records.acting import read_acting
from svsa.runs.records.catalogue.entry import RunPage
from svsa.runs.records.catalogue.runs import Catalogue
from svsa.runs.records.header import HEADER_FILE, RecordError, describe_newer
from svsa.runs.records.reader import Record, open_record
from svsa.runs.records.resimulation import Comparison, compare_with_simulation, read_origin
from svsa.runs.result.result import Result, build_results


def list_runs(search: str = "", page: int = 1, page_size: int = 50) -> RunPage:
    """The recorded runs of this machine, newest first; `Catalogue` can do more.

    search: words that must be in id, name, session, tags or notes.
    """
    return Catalogue().list(search=search, page=page, page_size=page_size)


def find_record(run: str | Path) -> Record:
    """The record of a run: its id in this machine's catalogue, or its folder.

    Raises `UnknownRunError` for an id that is not there, `RecordError` for what cannot be read.
    """
    folder = Path(run)
    if isinstance(run, Path) or (folder / HEADER_FILE).is_file():
        return open_record(folder)
    return Catalogue().open(run)


def open_run(run: str | Path) -> Result:
    """A recorded run as `simulate` would have returned it; its lanes as `comparisons`.

    run: its id, or its folder. The samples are those of the record, bit for bit; commands are
    those given while it was recorded or before; `fault` is None also for a record of a version
    that did not write it. On a bench the true disturbance is unknown (NaN). Raises `RecordError`
    for a record that cannot be read, of other channels, or of a configuration that this version
    does not know, `UnknownRunError` for an id that is not there. Warns of a record of a newer
    version.
    """
    record = find_record(run)
    header = record.header
    if newer := describe_newer(header.version):
        warnings.warn(f"Run {header.run_id}: {newer}", stacklevel=2)
    if header.channel_names != CHANNEL_NAMES:
        raise RecordError(f"Run {header.run_id} has other channels than this version of svsa.")
    try:
        configuration, commands = read_origin(record)
    except ParameterError as error:
        raise RecordError(f"Run {header.run_id} cannot be opened: {error}") from None
    acting = read_acting(header, record.commands, record.first_tick, record.tick_count)
    law, comparisons = acting.get_values("law")[0], acting.get_values("comparisons")[0]
    laws = (law, *(comparison.law for comparison in comparisons))
    samples = record.samples.transpose(1, 0, 2)
    if len(laws) != len(samples):
        laws = header.lanes
    name = header.name or header.run_id
    return build_results(
        configuration, samples, laws, record.fault, tuple(commands), name, header.plant
    )


def resimulate(run: str | Path) -> Comparison:
    """Simulate a recorded run again from its record alone and compare every bit."""
    return compare_with_simulation(find_record(run))


def export_run(run: str | Path, kind: str, target: Path | str) -> None:
    """Write a recorded run as "csv", "parquet", "mat" or "mcap"; see `records.export.formats`."""
    from svsa.runs.records.export.formats import (
        export,  # late: what the formats need takes a second
    )

    export(find_record(run), kind, target)

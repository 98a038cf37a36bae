"""Recorded runs in scripts: list, open, simulate again, compare, export.

Where a run is an argument, it is its id in this machine's catalogue, its folder, or a `Result`.
"""

import warnings
from collections.abc import Mapping, Sequence
from pathlib import Path

from svsa.actuators.signals import CHANNEL_NAMES
from svsa.errors import ParameterError
from svsa.runs.records.acting import read_acting
from svsa.runs.records.catalogue.entry import RunPage
from svsa.runs.records.catalogue.runs import Catalogue
from svsa.runs.records.header import HEADER_FILE, RecordError, describe_newer
from svsa.runs.records.reader import Record, open_record
from svsa.runs.records.resimulation import Comparison, compare_with_simulation, read_origin
from svsa.runs.records.verdict import Tolerance, Verdict, judge
from svsa.runs.result.channels import ChannelName
from svsa.runs.result.result import Result, build_results
from svsa.runs.result.saved import build_result_record


def list_runs(search: str = "", page: int = 1, page_size: int = 50) -> RunPage:
    """List the recorded runs of this machine, the newest first. `Catalogue` has more filters.

    Args:
        search: Words that are in the id, name, session, tags or notes.
        page: Number of the page, from 1.
        page_size: Runs of a page.

    Returns:
        The runs of the page, and the total number of runs found.

    Raises:
        ParameterError: For a page or page size out of range.
    """
    return Catalogue().list(search=search, page=page, page_size=page_size)


def find_record(run: str | Path | Result) -> Record:
    """Find the record of a run.

    Args:
        run: Id of a run in this machine's catalogue, its folder, or a result.

    Returns:
        The record.

    Raises:
        UnknownRunError: For an id that does not exist.
        RecordError: For a record that cannot be read.
        StateError: For a result that is one lane of a run, or has no samples.
    """
    if isinstance(run, Result):
        return build_result_record(run)
    folder = Path(run)
    if isinstance(run, Path) or (folder / HEADER_FILE).is_file():
        return open_record(folder)
    return Catalogue().open(run)


def open_run(run: str | Path) -> Result:
    """Read a recorded run as the `Result` that `svsa.simulate` would have returned.

    Its lanes are the `comparisons`. The samples are those of the record, bit for bit. Commands are
    those given while it was recorded or before. `fault` is None also for a record of a version that
    did not write it. On a bench the true disturbance is unknown (NaN). Warns of a record of a newer
    version.

    Args:
        run: Id of the run, or its folder.

    Returns:
        The run.

    Raises:
        RecordError: For a record that cannot be read, has other channels, or has a configuration
            that this version does not know.
        UnknownRunError: For an id that does not exist.
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
        configuration,
        samples,
        laws,
        record.fault,
        tuple(commands),
        name,
        header.plant,
        header.steps,
    )


def resimulate(run: str | Path | Result) -> Comparison:
    """Simulate a run again from its record alone, and compare every bit.

    Args:
        run: Id or folder of a recorded run, or a result of `svsa.simulate`.

    Returns:
        Whether every sample is identical, and the tick and channel of the first that is not.

    Raises:
        RecordError: For a run of a bench, of a function as controller, or of more than one
            integration step in a period.
    """
    return compare_with_simulation(find_record(run))


def compare_runs(
    run: str | Path | Result,
    other: str | Path | Result,
    *,
    absolute: float = 0.0,
    relative: float = 0.0,
    time_s: float = 0.0,
    channels: Sequence[ChannelName] | None = None,
    tolerances: Mapping[str, Tolerance] | None = None,
) -> Verdict:
    """Compare a run with another within tolerances, channel by channel and lane by lane.

    A value a is compared with b, any value of the other run within `time_s` of that time:
    |a − b| ≤ absolute + relative · |b|.

    Args:
        run: The run that is judged.
        other: The run that it should be.
        absolute: Tolerance in the unit of each channel.
        relative: Tolerance as a share of the other run's value.
        time_s: How much earlier or later a value may be, s.
        channels: Only these; left out, all.
        tolerances: Of single channels, in place of the three above.

    Returns:
        The verdict: `held`, and of every channel its worst moment.

    Raises:
        ParameterError: If a tolerance is negative or there is no such channel.
        RecordError: If the runs have other lanes or periods, or nothing in common.
    """
    rest = Tolerance(absolute=absolute, relative=relative, time_s=time_s)
    given = dict(tolerances or {})
    given |= {name: given.get(name, rest) for name in channels or ()}
    return judge(find_record(run), find_record(other), given, None if channels else rest)


def export_run(run: str | Path | Result, kind: str, target: Path | str) -> None:
    """Export a run to another format.

    Args:
        run: Id or folder of a recorded run, or a result of `svsa.simulate`.
        kind: "csv", "parquet", "mat", "mcap" or "html". "html" is one page with 3D replay and
            plots; it needs the extra `server`, but no running server.
        target: File to write.

    Raises:
        ParameterError: For another kind.
        RecordError: If the run cannot be written.
    """
    from svsa.runs.records.export.formats import (
        export,  # late: what the formats need takes a second
    )

    export(find_record(run), kind, target)

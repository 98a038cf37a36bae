"""Recorded runs in scripts: list, open, simulate again, compare, export.

A run is given by its id in this machine's catalogue, its folder, or a `Result`.
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
from svsa.runs.result.arm import ArmResult, build_arm_results
from svsa.runs.result.channels import ChannelName
from svsa.runs.result.result import Result, build_results
from svsa.runs.result.saved import build_arm_result_record, build_result_record


def list_runs(search: str = "", page: int = 1, page_size: int = 50) -> RunPage:
    """List the recorded runs of this machine, the newest first. `Catalogue` has more filters.

    Args:
        search: Words in the id, name, session, tags or notes.
        page: Number of the page, from 1.
        page_size: Runs per page.

    Returns:
        The runs of the page, and the total number of runs found.

    Raises:
        ParameterError: If page or page size are out of range.
    """
    return Catalogue().list(search=search, page=page, page_size=page_size)


def find_record(run: str | Path | Result | ArmResult) -> Record:
    """Find the record of a run.

    Args:
        run: Id of a run in this machine's catalogue, its folder, or a result.

    Returns:
        The record.

    Raises:
        UnknownRunError: If the id does not exist.
        RecordError: If the record cannot be read.
        StateError: If a result is one lane of a run or one joint of an arm, or has no samples.
    """
    if isinstance(run, Result):
        return build_result_record(run)
    if isinstance(run, ArmResult):
        return build_arm_result_record(run)
    folder = Path(run)
    if isinstance(run, Path) or (folder / HEADER_FILE).is_file():
        return open_record(folder)
    return Catalogue().open(run)


def open_run(run: str | Path) -> Result:
    """Read a recorded run as the `Result` that `svsa.simulate` would have returned.

    Its lanes are the `comparisons`. The samples are those of the record, bit for bit; a channel
    that the record lacks is NaN, and one that this version does not know is left out. Commands are
    those given while it was recorded or before. `fault` is None also for a record of a version that
    did not write it. On a bench the true disturbance is unknown (NaN). Warns if a newer version
    wrote the record.

    Args:
        run: Id of the run, or its folder.

    Returns:
        The run.

    Raises:
        RecordError: If the record cannot be read, or has a configuration that this version does not
            support.
        UnknownRunError: If the id does not exist.
    """
    record = find_record(run)
    header = record.header
    if header.is_arm:
        raise RecordError(f"Run {header.run_id} is one of an arm: open it with svsa.open_arm_run.")
    if newer := describe_newer(header.version):
        warnings.warn(f"Run {header.run_id}: {newer}", stacklevel=2)
    try:
        configuration, commands = read_origin(record)
    except ParameterError as error:
        raise RecordError(f"Run {header.run_id} cannot be opened: {error}") from None
    acting = read_acting(header, record.commands, record.first_tick, record.tick_count)
    law, comparisons = acting.get_values("law")[0], acting.get_values("comparisons")[0]
    laws = (law, *(comparison.law for comparison in comparisons))
    samples = record.read_channels(CHANNEL_NAMES).transpose(1, 0, 2)
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


def open_arm_run(run: str | Path) -> ArmResult:
    """Read a recorded arm as the `ArmResult` that `svsa.simulate_arm` would have returned.

    The samples are those of the record, bit for bit; a channel that it lacks is NaN.

    Args:
        run: Id of the run, or its folder.

    Returns:
        The run; its comparison is the second arm.

    Raises:
        RecordError: For a record that cannot be read, is not one of an arm, or has a configuration
            that this version does not know.
    """
    record = find_record(run)
    header = record.header
    if not header.is_arm:
        raise RecordError(f"Run {header.run_id} is not one of an arm: open it with svsa.open_run.")
    try:
        configuration, commands = read_origin(record)
    except ParameterError as error:
        raise RecordError(f"Run {header.run_id} cannot be opened: {error}") from None
    samples = record.read_channels(CHANNEL_NAMES).transpose(1, 0, 2)
    return build_arm_results(configuration, samples, record.fault, header.steps, tuple(commands))


def resimulate(run: str | Path | Result | ArmResult) -> Comparison:
    """Simulate a run again from its record alone, and compare every bit.

    Args:
        run: Id or folder of a recorded run, or a result of `svsa.simulate` or `svsa.simulate_arm`.

    Returns:
        Whether every sample is identical, the tick and channel of the first one that is not, and
        the channels that were not compared, since only the record or only this version has them.

    Raises:
        RecordError: If the run is of a bench, of a function as controller, or has more than one
            integration step per period.
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

    A value a is compared with b, any value of the other run within `time_s` of that time: |a − b| ≤
    absolute + relative · |b|.

    Args:
        run: The run.
        other: The reference run.
        absolute: Tolerance in the unit of each channel.
        relative: Tolerance as a share of the reference run's value.
        time_s: Tolerance in time, s.
        channels: Channels to compare; by default all.
        tolerances: Tolerances of single channels, instead of the three above.

    Returns:
        The verdict: `held`, and the largest deviation of every channel.

    Raises:
        ParameterError: If a tolerance is negative or there is no such channel.
        RecordError: If the runs differ in lanes or periods, or have no common time.
    """
    rest = Tolerance(absolute=absolute, relative=relative, time_s=time_s)
    by_channel = dict(tolerances or {})
    by_channel |= {name: by_channel.get(name, rest) for name in channels or ()}
    return judge(find_record(run), find_record(other), by_channel, None if channels else rest)


def export_run(run: str | Path | Result, kind: str, target: Path | str) -> None:
    """Export a run to another format.

    Args:
        run: Id or folder of a recorded run, or a result of `svsa.simulate`.
        kind: "csv", "parquet", "mat", "mcap" or "html". "html" is one page with 3D replay and
            plots; it needs the extra `server`, but no running server.
        target: File to write.

    Raises:
        ParameterError: If the format is unknown.
        RecordError: If the run cannot be written.
    """
    from svsa.runs.records.export.formats import (
        export,  # imported here: the packages of the formats take a second
    )

    export(find_record(run), kind, target)

"""`svsa compare`: compare a recorded run with a reference run within tolerances."""

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, cast

import typer
from pydantic_core import to_jsonable_python
from rich.console import Console
from rich.table import Table

from svsa.errors import ParameterError, SvsaError, Violation
from svsa.inputs.toml_file import describe_place, read_toml

if TYPE_CHECKING:
    from svsa.runs.records.verdict import Tolerance, Verdict
    from svsa.runs.result.channels import ChannelName

NOT_HELD, REFUSED = 1, 2
_messages = Console(stderr=True)


def compare(
    run: Annotated[str, typer.Argument(help="Run under test: its id or folder.")],
    other: Annotated[str, typer.Argument(help="Reference run: its id or folder.")],
    absolute: Annotated[
        float, typer.Option(help="Absolute tolerance, in the unit of the channel.")
    ] = 0.0,
    relative: Annotated[
        float, typer.Option(help="Relative tolerance, as a share of the reference value.")
    ] = 0.0,
    time_s: Annotated[float, typer.Option("--time", help="Time tolerance, s.")] = 0.0,
    channel: Annotated[
        list[str] | None, typer.Option(help="Compare only this channel; repeatable.")
    ] = None,
    tolerances: Annotated[
        Path | None,
        typer.Option(help="TOML file: a table per channel (absolute, relative, time_s)."),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
) -> None:
    """Compare a run with a reference run, channel by channel.

    Exit code 0: all channels are within tolerance; 1: a channel is outside; 2: not comparable.
    """
    from svsa.runs.records.header import describe_newer
    from svsa.runs.result.recorded import compare_runs, find_record

    try:
        for header in (find_record(name).header for name in (run, other)):
            if newer := describe_newer(header.version):
                _messages.print(f"Note: {header.run_id}: {newer}", highlight=False, markup=False)
        verdict = compare_runs(
            run,
            other,
            absolute=absolute,
            relative=relative,
            time_s=time_s,
            channels=cast("list[ChannelName] | None", channel),
            tolerances=read_tolerances(tolerances) if tolerances else None,
        )
    except (SvsaError, OSError) as error:
        _messages.print(f"Error: {error}", style="bold red", highlight=False, markup=False)
        raise typer.Exit(REFUSED) from None
    if as_json:
        print(json.dumps(to_jsonable_python(verdict, inf_nan_mode="null"), indent=2))
    else:
        Console().print(*build_verdict_table(verdict))
    raise typer.Exit(0 if verdict.held else NOT_HELD)


def read_tolerances(path: Path) -> "dict[str, Tolerance]":
    """Read tolerances by channel from a TOML file.

    Raises:
        ParameterError: If a value is invalid, with file and lines.
    """
    from svsa.runs.records.verdict import Tolerance

    read: dict[str, Tolerance] = {}
    violations: list[Violation] = []
    for name, table in read_toml(path, "tolerance file").items():
        if not isinstance(table, dict):
            violations.append(Violation(name, table, "", "a table: absolute, relative, time_s"))
            continue
        try:
            read[name] = Tolerance(**table)
        except ParameterError as error:
            violations += error.within(name).violations
    if violations:
        names = [violation.name for violation in violations]
        place = describe_place(str(path), path.read_text(encoding="utf-8"), names)
        raise ParameterError(*violations, file=place)
    return read


def build_verdict_table(verdict: "Verdict") -> list[Table | str]:
    """Build a table with each channel's worst moment, and the verdict in a line."""
    table = Table("lane", "channel", "unit", "held", "worst at", "value", "band")
    for judged in verdict.channels:
        held = "yes" if judged.held else "NO"
        band = f"{judged.low:.6g} to {judged.high:.6g}"
        cells = f"{judged.worst_s:.6g} s", f"{judged.value:.6g}", band
        table.add_row(judged.lane, judged.channel, judged.unit, held, *cells)
    failed = sum(not judged.held for judged in verdict.channels)
    conclusion = f"{failed} of {len(verdict.channels)} channels not held" if failed else "All held"
    conclusion += f" over {verdict.ticks} ticks"
    if verdict.own_ticks != verdict.other_ticks:
        lengths = f"not as long: {verdict.own_ticks} and {verdict.other_ticks} ticks"
        conclusion = f"Not held: {lengths}. {conclusion}"
    return [table, f"{conclusion}."]

"""The header of a record: version, run, lanes, channels, design."""

import contextlib
import json
import os
import re
import secrets
import threading
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Literal, Self

from pydantic import model_validator

from svsa.actuators.signals import CHANNELS, Channel
from svsa.errors import ParameterError, SvsaError, Violation
from svsa.inputs.checked import Checked, Number, Whole, quantity
from svsa.inputs.extras import __version__
from svsa.inputs.stored_file import load_json
from svsa.runs.definition.configuration import Configuration
from svsa.runs.records.former_words import translate_configuration

FORMAT = 1
LONGEST_NAME = 200
LONGEST_NOTES = 10_000
LONGEST_TAG = 50
MAX_TAGS = 20
LONGEST_LANE = 60
LARGEST_TEXT_BYTES = 1 << 24

HEADER_FILE = "header.json"
COMMANDS_FILE = "commands.jsonl"
STREAM_FILE = "samples.arrows"
PARQUET_FILE = "samples.parquet"

PlantKind = Literal["simulated", "emulated", "bench"]

_RUN_ID = re.compile(r"[0-9A-Za-z][0-9A-Za-z_-]{0,63}", re.ASCII)
_CHANNEL = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,62}", re.ASCII)


class RecordError(SvsaError):
    """A record cannot be written, found or read; existing files stay unchanged."""


@dataclass(frozen=True)
class BranchPoint:
    """The recorded run that a session continues, and the tick at which it branched."""

    run_id: str
    tick: int


class RecordHeader(Checked):
    """All metadata of a record except commands and samples; JSON in `header.json`.

    A simulated run can be simulated again from `configuration` (which includes the seed) and the
    commands.

    Raises:
        ParameterError: If a value is invalid.
    """

    format: Whole = quantity("", "Version of the format", ge=1, default=FORMAT)
    version: str = quantity("", "Version of svsa that recorded it")
    run_id: str = quantity("", "Id of the run: letters, digits, - and _")
    created: str = quantity("", "Start of the recording, UTC, ISO 8601")
    session: str = quantity("", "Recorded session")
    plant: PlantKind = quantity("", "Plant of lane 1", default="simulated")
    name: str = quantity("", "Name of the run", default="")
    tags: tuple[str, ...] = quantity("", "Tags", default=())
    notes: str = quantity("", "Notes of the user", default="")
    owner: str = quantity(
        "", "Id of the user who recorded it, in a class; otherwise empty", default=""
    )
    branch_of: BranchPoint | None = quantity(
        "", "Run and tick from which this one continues", default=None
    )
    lanes: tuple[str, ...] = quantity("", "Name of every lane, in the order of the samples")
    configuration: dict[str, Any] = quantity("", "The run's configuration at tick 0")
    seed: Whole = quantity("", "Seed of the sensor noise", ge=0, le=2**63 - 1)
    period_s: Number = quantity("s", "Control period T", gt=0, le=10)
    steps: Whole = quantity("", "Runge–Kutta steps per control period", ge=1, default=1)
    channels: tuple[Channel, ...] = quantity("", "Name, unit and label of every channel")

    @model_validator(mode="after")
    def _check(self) -> Self:
        if not is_run_id(self.run_id):
            bound = "1 to 64 letters, digits, - or _; the first one a letter or digit"
            raise ParameterError(Violation("run_id", self.run_id, "", bound))
        if not _is_time(self.created):
            bound = "a time of ISO 8601 with its zone, as 2026-01-02T03:04:05+00:00"
            raise ParameterError(Violation("created", self.created, "", bound))
        check_texts(self.name, self.tags, self.notes)
        if not self.lanes or len(set(self.lanes)) < len(self.lanes):
            raise ParameterError(Violation("lanes", list(self.lanes), "", "names, each once"))
        for lane in self.lanes:
            check_text("lanes", lane, LONGEST_LANE, least=1)
        names = self.channel_names
        if not names or len(set(names)) < len(names) or not all(map(_CHANNEL.fullmatch, names)):
            bound = "names of letters, digits and _, each once"
            raise ParameterError(Violation("channels", list(names), "", bound))
        return self

    @property
    def channel_names(self) -> tuple[str, ...]:
        """The names of the channels, in the order of the samples."""
        return tuple(channel.name for channel in self.channels)

    @property
    def is_arm(self) -> bool:
        """Whether the run is one of an arm: two lanes for each."""
        return self.configuration.get("arm") is not None

    def to_json(self) -> str:
        """The header as a JSON object."""
        return self.model_dump_json()


def build_header(configuration: Configuration, lane_count: int, **known: Any) -> RecordHeader:
    """Build the header of a new record, with a new id.

    Args:
        configuration: Configuration of the run at tick 0.
        lane_count: 1 to 4.
        **known: Other fields of the header.

    Returns:
        The header.

    Raises:
        ParameterError: If a value is out of range.
    """
    values = {
        "version": __version__,
        "run_id": build_run_id(),
        "created": datetime.now(UTC).isoformat(timespec="milliseconds"),
        "lanes": tuple(f"lane{number + 1}" for number in range(lane_count)),
        "configuration": configuration.model_dump(mode="json"),
        "seed": configuration.seed,
        "period_s": configuration.sampling.period_s,
        "channels": CHANNELS,
    }
    return RecordHeader(**(values | known))


def build_run_id() -> str:
    """Build an id for a new run: UTC time and a random number."""
    return f"{datetime.now(UTC):%Y%m%d-%H%M%S}-{secrets.token_hex(4)}"


def read_header(folder: Path) -> RecordHeader:
    """Read the header in a record's folder.

    Raises:
        RecordError: If there is none.
    """
    path = folder / HEADER_FILE
    check_files(folder)
    try:
        return parse_header(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise RecordError(f"Record {folder.name} has no {HEADER_FILE}.") from None
    except (OSError, UnicodeDecodeError, RecordError) as error:
        raise RecordError(f"{HEADER_FILE} of record {folder.name} is damaged: {error}") from None


def check_files(folder: Path) -> None:
    """Raise `RecordError` if reading a file could block or take all memory."""
    with contextlib.suppress(OSError):  # reported by the access itself
        for path in folder.iterdir():
            text = f"{path.name} of record {folder.name}"
            if path.exists() and not (path.is_file() or path.is_dir()):
                raise RecordError(f"{text} is not a file.")
            size = path.stat().st_size if path.suffix == ".json" else 0
            if size > LARGEST_TEXT_BYTES:
                raise RecordError(f"{text} has {size} bytes, more than {LARGEST_TEXT_BYTES}.")


def parse_header(text: str) -> RecordHeader:
    """Parse a header from its JSON.

    Raises:
        RecordError: If it is not a header.
    """
    try:
        written = load_json(text)
    except ValueError as error:
        raise RecordError(f"not JSON ({error})") from None
    if not isinstance(written, dict):
        raise RecordError("not a JSON object")
    newer = describe_newer(str(written.get("version", "")))
    if written.get("format") != FORMAT:
        known = f"this version of svsa reads format {FORMAT}. {newer}".strip()
        raise RecordError(f"format {str(written.get('format'))[:40]}, but {known}")
    if newer:
        written = {name: written[name] for name in written if name in RecordHeader.model_fields}
    try:
        json.dumps(written, ensure_ascii=False).encode()  # rejects surrogates
        if "configuration" in written:
            written["configuration"] = translate_configuration(written["configuration"])
        return RecordHeader(**written)
    except (ParameterError, TypeError, ValueError, AttributeError) as error:
        raise RecordError(str(error)) from None


def describe_newer(version: str) -> str:
    """Return a note if a newer version of svsa wrote a record; otherwise an empty text.

    Args:
        version: Version that wrote the record.

    Returns:
        The note.
    """
    if _read_release(version) <= _read_release(__version__):
        return ""
    return (
        f"Recorded by svsa {version[:40]}, which is newer than the installed {__version__}:"
        " settings that are unknown here are ignored."
    )


def _read_release(version: str) -> tuple[int, ...]:
    """Parse a version for comparison: "0.10.0" is (0, 10)."""
    numbers = [int(number) for number in re.findall(r"\d{1,9}", version.partition("+")[0])]
    while numbers and numbers[-1] == 0:
        numbers.pop()
    return tuple(numbers)


def write_header(folder: Path, header: RecordHeader) -> None:
    """Write or replace the header atomically."""
    replace_file(folder / HEADER_FILE, header.to_json().encode())


def replace_file(path: Path, content: bytes) -> None:
    """Replace a file atomically.

    Raises:
        OSError: If it cannot be written; the old file is unchanged.
    """
    # The name contains process and thread, so that two writers do not share a draft.
    draft = path.with_name(f"{path.name}.{os.getpid()}-{threading.get_ident()}.tmp")
    try:
        with draft.open("wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        draft.replace(path)
    finally:
        draft.unlink(missing_ok=True)


def is_run_id(text: str) -> bool:
    """Whether `text` is a valid name of a run's folder."""
    return _RUN_ID.fullmatch(text) is not None


def _is_time(text: str) -> bool:
    try:
        return datetime.fromisoformat(text).tzinfo is not None
    except ValueError:
        return False


def check_texts(name: str, tags: tuple[str, ...], notes: str) -> None:
    """Raise `ParameterError` for a name, tag or note that is too long or not a text."""
    check_text("name", name, LONGEST_NAME)
    check_text("notes", notes, LONGEST_NOTES)
    if len(tags) > MAX_TAGS or len(set(tags)) < len(tags):
        raise ParameterError(Violation("tags", list(tags), "", f"at most {MAX_TAGS}, each once"))
    for tag in tags:
        check_text("tags", tag, LONGEST_TAG, least=1)


def check_text(name: str, text: str, longest: int, least: int = 0) -> None:
    """Raise `ParameterError` unless `text` has `least` to `longest` characters of Unicode."""
    if not least <= len(text) <= longest:
        bound = f"a text of {least} to {longest} characters ({len(text)} were given)"
        raise ParameterError(Violation(name, text, "", bound))
    try:
        text.encode()
    except UnicodeEncodeError:
        bound = "valid Unicode text, without surrogates"
        raise ParameterError(Violation(name, text, "", bound)) from None

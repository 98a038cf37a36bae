"""MAT, version 5: one struct per lane, one column per channel; for MATLAB and GNU Octave.

Texts are ASCII, because Octave truncates others: a unit is written N*m/rad, other characters become
?. `jsondecode(run.header_json)` returns the original texts, and `jsondecode(run.metrics_json)` the
metrics of every lane.
"""

import json
from collections.abc import Iterable
from dataclasses import asdict
from typing import IO, Any

import numpy as np

from svsa.runs.records.header import RecordError
from svsa.runs.records.measured_window import write_metrics
from svsa.runs.records.reader import Record

MAX_BYTES_A_LANE = 2**31 - 2**20
LONGEST_WORD = 63


def write_mat(record: Record, stream: IO[bytes]) -> None:
    """Write a record as MAT: tick, time_s, units, run, and a struct for every lane.

    Raises:
        RecordError: If a lane exceeds the format's limit of 2 GB.
    """
    header, names = record.header, build_identifiers(record.header.channel_names)
    if 8 * record.tick_count * len(names) > MAX_BYTES_A_LANE:
        most = MAX_BYTES_A_LANE // (8 * len(names))
        text = f"{record.tick_count} ticks are too many for MAT, which holds {most}"
        raise RecordError(f"Run {header.run_id} cannot be exported: {text}; choose Parquet.")
    reserved = ["tick", "time_s", "units", "run"]
    lanes = build_identifiers([*reserved, *header.lanes])[len(reserved) :]
    ticks = np.arange(record.first_tick, record.first_tick + record.tick_count)
    content: dict[str, Any] = {
        "tick": ticks[:, None],
        "time_s": (ticks * header.period_s)[:, None],
        "units": {
            name: _spell(channel.unit) for name, channel in zip(names, header.channels, strict=True)
        },
        "run": _describe(record),
    }
    samples = record.samples
    for number, lane in enumerate(lanes):
        columns = {name: samples[:, number, [i]] for i, name in enumerate(names)}
        content[lane] = columns
        content["time_s"] = columns.get("time_s", content["time_s"])
    from scipy.io import savemat  # the import takes 0.15 s, and few users need this format

    savemat(stream, content, long_field_names=True, do_compression=True, oned_as="column")


def build_identifiers(texts: Iterable[str]) -> list[str]:
    """Build a distinct MATLAB identifier for each text."""
    taken: list[str] = []
    for text in texts:
        letters = [letter if letter.isascii() and letter.isalnum() else "_" for letter in text]
        word = "".join(letters).strip("_") or "lane"
        word = (word if word[0].isalpha() else f"x{word}")[:LONGEST_WORD]
        free, number = word, 2
        while free in taken or free in _KEYWORDS:
            ending = f"_{number}"
            free, number = word[: LONGEST_WORD - len(ending)] + ending, number + 1
        taken.append(free)
    return taken


def _describe(record: Record) -> dict[str, Any]:
    header = record.header
    commands = [{"tick": tick, "command": command} for tick, command in record.commands]
    texts = {
        "id": header.run_id,
        "name": header.name,
        "notes": header.notes,
        "tags": ", ".join(header.tags),
        "session": header.session,
        "created": header.created,
        "version": header.version,
        "lanes": ", ".join(header.lanes),
        "header_json": json.dumps(header.model_dump(mode="json")),
        "commands_json": json.dumps(commands),
        "metrics_json": write_metrics(record),
        "events_json": json.dumps([asdict(event) for event in record.events]),
    }
    numbers = {"period_s": header.period_s, "seed": np.int64(header.seed)}
    return {name: _spell(text) for name, text in texts.items()} | numbers


def _spell(text: str) -> str:
    return text.replace("·", "*").encode("ascii", "replace").decode()


_KEYWORDS = frozenset(
    [
        "break",
        "case",
        "catch",
        "classdef",
        "continue",
        "else",
        "elseif",
        "end",
        "for",
        "function",
        "global",
        "if",
        "otherwise",
        "parfor",
        "persistent",
        "return",
        "spmd",
        "switch",
        "try",
        "while",
    ]
)

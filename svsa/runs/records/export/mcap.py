"""MCAP for Foxglove: joint states and all channels as time series, one topic of each per lane.

`foxglove.JointStates` is a schema of Foxglove, which its 3D view uses for joints. Plots accept
numbers of any JSON schema, so `svsa.Sample` contains every channel with its unit. Messages are
JSON; their time is the time of day.
"""

import json
import math
from collections.abc import Iterator
from datetime import datetime
from typing import IO, Any, NamedTuple

import msgspec
from mcap.writer import Writer

from svsa.inputs.extras import __version__
from svsa.runs.records.export.mcap_schemas import COMMAND, EVENT, JOINT_STATES, build_sample_schema
from svsa.runs.records.header import RecordHeader
from svsa.runs.records.measured_window import write_metrics
from svsa.runs.records.reader import Record

NANOSECONDS = 1_000_000_000
ROWS_A_STRETCH = 4096


class Joint(NamedTuple):
    """A joint and the channels of its position, velocity and torque."""

    name: str
    position: str
    velocity: str
    effort: str


JOINTS = (
    Joint("link", "position_rad", "velocity_rad_per_s", ""),
    Joint("motor1", "motor1_position_rad", "motor1_velocity_rad_per_s", "torque1_nm"),
    Joint("motor2", "motor2_position_rad", "motor2_velocity_rad_per_s", "torque2_nm"),
)


def write_mcap(record: Record, stream: IO[bytes]) -> None:
    """Write a record as MCAP: /<lane>/samples, /<lane>/joint_states, /commands, /events.

    The metadata `svsa` contain header and metrics as JSON.
    """
    header, names = record.header, record.header.channel_names
    joints = [joint for joint in JOINTS if joint.position in names]
    began_ns = round(datetime.fromisoformat(header.created).timestamp() * NANOSECONDS)
    period_ns = header.period_s * NANOSECONDS
    writer = Writer(stream)
    writer.start(library=f"svsa {__version__}")
    topics = _add_topics(writer, header)
    _write_commands(writer, record, began_ns, period_ns)
    _write_events(writer, record, began_ns, period_ns)
    for tick, lanes in _iterate_rows(record):
        time_ns = began_ns + round(tick * period_ns)
        stamp = {"sec": time_ns // NANOSECONDS, "nsec": time_ns % NANOSECONDS}
        for (sample_topic, state_topic), values in zip(topics, lanes, strict=True):
            sample = dict(zip(names, values, strict=True))
            states = [_build_state(joint, sample) for joint in joints]
            for topic, message in (
                (sample_topic, {"timestamp": stamp, "tick": tick, **sample}),
                (state_topic, {"timestamp": stamp, "joints": states}),
            ):
                writer.add_message(topic, time_ns, msgspec.json.encode(message), time_ns)
    metadata = {"header": header.to_json(), "metrics": write_metrics(record)}
    writer.add_metadata("svsa", metadata)
    writer.finish()


def _iterate_rows(record: Record) -> Iterator[tuple[int, list[list[float]]]]:
    for first_tick, samples in record.iterate():
        for start in range(0, len(samples), ROWS_A_STRETCH):
            rows = samples[start : start + ROWS_A_STRETCH].tolist()
            yield from enumerate(rows, first_tick + start)


def _build_state(joint: Joint, sample: dict[str, float]) -> dict[str, Any]:
    """Build a `foxglove.JointState` without unknown values."""
    channels = {"position": joint.position, "velocity": joint.velocity, "effort": joint.effort}
    values = {key: sample.get(channel, math.nan) for key, channel in channels.items()}
    return {"name": joint.name} | {k: value for k, value in values.items() if math.isfinite(value)}


def _add_topics(writer: Writer, header: RecordHeader) -> list[tuple[int, int]]:
    """Add the topics of samples and of joint states for every lane."""
    sample_schema = _add_schema(writer, build_sample_schema(header))
    state_schema = _add_schema(writer, JOINT_STATES)
    topics = []
    for lane in header.lanes:
        name = lane.replace("/", "_").replace(" ", "_")
        samples = writer.register_channel(f"/{name}/samples", "json", sample_schema)
        states = writer.register_channel(f"/{name}/joint_states", "json", state_schema)
        topics.append((samples, states))
    return topics


def _write_commands(writer: Writer, record: Record, began_ns: int, period_ns: float) -> None:
    topic = writer.register_channel("/commands", "json", _add_schema(writer, COMMAND))
    for tick, command in record.commands:
        message = msgspec.json.encode({"tick": tick, "command": command})
        time_ns = began_ns + round(tick * period_ns)
        writer.add_message(topic, time_ns, message, time_ns)


def _write_events(writer: Writer, record: Record, began_ns: int, period_ns: float) -> None:
    if not record.events:
        return
    topic = writer.register_channel("/events", "json", _add_schema(writer, EVENT))
    for event in record.events:
        time_ns = began_ns + round(event.tick * period_ns)
        writer.add_message(topic, time_ns, msgspec.json.encode(event), time_ns)


def _add_schema(writer: Writer, schema: dict[str, Any]) -> int:
    return writer.register_schema(schema["title"], "jsonschema", json.dumps(schema).encode())

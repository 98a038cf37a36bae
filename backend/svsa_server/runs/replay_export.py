"""A recorded run as one self-contained page with 3D replay and plots."""

from collections.abc import Sequence

import numpy as np

from svsa.runs.definition.command import Command
from svsa.runs.definition.configuration import Configuration
from svsa.runs.records.difference import describe_configuration
from svsa.runs.records.measured_window import find_measured_window, trace_record
from svsa.runs.records.reader import Record
from svsa.runs.records.resimulation import read_origin
from svsa.runs.records.settings import describe_settings
from svsa.runs.timeline.events import list_events
from svsa.runs.timeline.loads import list_loads
from svsa_scene.pose import LaneSegment
from svsa_scene.replay import build_replay_html
from svsa_scene.replay_scenes import ReplayArm
from svsa_server.runs.lanes import list_record_segments, name_lanes
from svsa_server.runs.tip_load import trace_tip_loads
from svsa_server.schemas.runs.lane import SegmentState


def build_replay(record: Record) -> str:
    """Build the page's HTML. Reads the complete record and takes seconds: not in the event loop.

    Raises:
        ParameterError: If the record lacks a channel that the view needs.
    """
    header = record.header
    segments = list_record_segments(record, trace_record(record))
    origin = read_origin(record)
    settings = describe_settings(header, record.commands, record.first_tick, record.tick_count)
    return build_replay_html(
        header.name or settings.name or f"Run {header.run_id}",
        header.period_s,
        name_lanes(segments),
        list(header.channel_names),
        record.samples,
        compute_hung_mass(record),
        {
            "Version": header.version,
            "Recorded": header.created,
            "Session": header.session,
            "Seed": header.seed,
            "Notes": header.notes,
            "Fault": "" if record.fault is None else record.fault.message,
            **describe_configuration(origin[0]),
            "Changes": [
                {"Time, s": command.tick * header.period_s, "Change": command.label}
                for command in origin[1]
            ],
        },
        plant=header.plant,
        events=list_events(*origin, record.fault, record.events),
        first_tick=record.first_tick,
        actuator=origin[0].actuator,
        arm=_find_arm(*origin, record.first_tick),
        window=find_measured_window(record),
        segments=[[_place(record, segment) for segment in lane] for lane in segments],
    )


def _find_arm(
    configuration: Configuration, commands: Sequence[Command], first_tick: int
) -> ReplayArm | None:
    arm = configuration.arm
    if arm is None:
        return None
    loads = trace_tip_loads(configuration, commands, first_tick)
    return ReplayArm(arm.links, [joint.actuator for joint in configuration.joints], loads)


def _place(record: Record, segment: SegmentState) -> LaneSegment:
    """Convert a segment to the record's own ticks."""
    first = max(0, segment.start_tick - record.first_tick)
    end = record.tick_count
    if segment.end_tick is not None:
        end = min(end, segment.end_tick - record.first_tick)
    number, has_estimate = segment.number, segment.has_estimate
    return LaneSegment(segment.name, segment.line_style, number, first, end, has_estimate)


def compute_hung_mass(record: Record) -> np.ndarray:
    """Compute the mass on the link at every tick of the record, kg, (ticks,)."""
    return trace_hung_mass(*read_origin(record), record.first_tick, record.tick_count)


def trace_hung_mass(
    configuration: Configuration, commands: Sequence[Command], first_tick: int, tick_count: int
) -> np.ndarray:
    """Trace the mass on the link at `tick_count` ticks of a run, kg, (tick_count,)."""
    ticks = np.arange(first_tick, first_tick + tick_count)
    mass = np.zeros(tick_count)
    for _, load, start, end, _ in list_loads(configuration, commands):
        mass[(ticks >= start) & (ticks < end)] += load.get_hung_mass()
    return mass

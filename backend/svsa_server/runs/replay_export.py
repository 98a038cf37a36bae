"""A recorded run as one page with 3D replay and plots, which needs no server."""

from collections.abc import Sequence

import numpy as np

from svsa.runs.command import Command
from svsa.runs.configuration import Configuration
from svsa.runs.events import list_events
from svsa.runs.records.measured_window import find_measured_window, trace_record
from svsa.runs.records.reader import Record
from svsa.runs.records.resimulation import read_origin
from svsa.runs.records.settings import describe_settings
from svsa.runs.replay import list_loads
from svsa_scene.pose import LaneStretch
from svsa_scene.replay import build_replay_html
from svsa_server.runs.lanes import list_record_stretches, name_lanes
from svsa_server.schemas.runs.lane import StretchState


def build_replay(record: Record) -> str:
    """The page's HTML. Reads the whole record and takes seconds: not for the event loop.

    Raises `ParameterError` where the record lacks a channel that the view needs.
    """
    header = record.header
    stretches = list_record_stretches(record, trace_record(record))
    settings = describe_settings(header, record.commands, record.first_tick, record.tick_count)
    return build_replay_html(
        header.name or settings.name or f"Run {header.run_id}",
        header.period_s,
        name_lanes(stretches),
        list(header.channel_names),
        record.samples,
        compute_hung_mass(record),
        {
            "version": header.version,
            "recorded": header.created,
            "session": header.session,
            "seed": header.seed,
            "plant": header.plant,
            "notes": header.notes,
            "configuration": header.configuration,
            "fault": "" if record.fault is None else record.fault.message,
            "commands": [command for _, command in record.commands],
        },
        events=list_events(*read_origin(record), record.fault, record.events),
        first_tick=record.first_tick,
        window=find_measured_window(record),
        stretches=[[_place(record, one) for one in lane] for lane in stretches],
    )


def _place(record: Record, stretch: StretchState) -> LaneStretch:
    """A stretch in the record's own ticks."""
    first = max(0, stretch.start_tick - record.first_tick)
    end = record.tick_count
    if stretch.end_tick is not None:
        end = min(end, stretch.end_tick - record.first_tick)
    return LaneStretch(stretch.name, stretch.line_style, stretch.number, first, end)


def compute_hung_mass(record: Record) -> np.ndarray:
    """The mass on the link at every tick of the record, kg, (ticks,)."""
    return trace_hung_mass(*read_origin(record), record.first_tick, record.tick_count)


def trace_hung_mass(
    configuration: Configuration, commands: Sequence[Command], first_tick: int, tick_count: int
) -> np.ndarray:
    """The mass on the link at so many ticks of a run, kg, (tick_count,)."""
    ticks = np.arange(first_tick, first_tick + tick_count)
    mass = np.zeros(tick_count)
    for _, load, start, end in list_loads(configuration, commands):
        mass[(ticks >= start) & (ticks < end)] += load.get_hung_mass()
    return mass

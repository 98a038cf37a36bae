"""A recorded run as one page with 3D replay and plots, which needs no server."""

import numpy as np

from svsa.plant.disturbances import get_hung_mass
from svsa.runtime.recording.reader import Record
from svsa.runtime.resimulation import read_origin
from svsa.runtime.run import Run
from svsa_scene.replay import build_replay_html
from svsa_server.lane_names import name_lanes


def build_replay(record: Record) -> str:
    """The page's HTML. Reads the whole record and takes seconds: not for the event loop.

    Raises `ParameterError` where the record lacks a channel that the view needs.
    """
    header = record.header
    return build_replay_html(
        header.name or f"Run {header.run_id}",
        header.period_s,
        name_lanes(record),
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
            "commands": [command for _, command in record.commands],
        },
        first_tick=record.first_tick,
    )


def compute_hung_mass(record: Record) -> np.ndarray:
    """The mass on the link at every tick of the record, kg, (ticks,)."""
    configuration, commands = read_origin(record)
    run = Run(configuration)
    spans = {load.number: (load.start_tick, load.end_tick, load.load) for load in run.loads}
    for command in commands:
        if command.kind not in ("load", "unload"):
            continue
        run.tick = command.tick
        command.apply(run)
        for number, load, start, end in run.loads:
            spans[number] = (start, end, load)
        if command.kind == "unload":
            start, end, load = spans[command.argument]
            spans[command.argument] = (start, min(end, command.tick), load)
    ticks = np.arange(record.first_tick, record.first_tick + record.tick_count)
    mass = np.zeros(len(ticks))
    for start, end, load in spans.values():
        mass[(ticks >= start) & (ticks < end)] += get_hung_mass(load)
    return mass

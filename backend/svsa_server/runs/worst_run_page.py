"""The worst run of a leaderboard entry as one page with 3D replay and plots."""

import numpy as np

from svsa.actuators.signals import CHANNELS
from svsa.runs.records.difference import describe_configuration
from svsa.runs.records.measured_window import MeasuredWindow
from svsa.runs.timeline.events import list_events
from svsa.teaching.leaderboard.board import Board, Entry
from svsa.teaching.leaderboard.worst_run import replay_worst
from svsa_scene.replay import build_replay_html
from svsa_server.runs.replay_export import trace_hung_mass


def build_worst_run_page(board: Board, entry: Entry) -> str:
    """Build the page's HTML, in seconds. The measured window is that of the leaderboard's error.

    Raises:
        StateError: If the run was not saved, or ended at its first tick.
    """
    scenario, lanes, result, alone = replay_worst(board, entry)
    notes = ("Its worst run on the leaderboard.", entry.standing.worst.problem, alone)
    samples = np.stack(
        [result.samples, *(comparison.samples for comparison in result.comparisons)], axis=1
    )
    period_s = result.configuration.sampling.period_s
    ticks = len(samples)
    first = round(scenario.measured_s / period_s)
    start = first if first < ticks else 0
    settings = describe_configuration(result.configuration)
    settings["Controller"]["Law"] = lanes[0]
    return build_replay_html(
        f"{lanes[0]}: {scenario.title}",
        period_s,
        list(lanes),
        [channel.name for channel in CHANNELS],
        samples,
        trace_hung_mass(result.configuration, (), 0, ticks),
        {
            "Version": entry.version,
            "Measured": entry.entered,
            "Notes": " ".join(filter(None, notes)),
            "Seed": result.configuration.seed,
            "Fault": "" if result.fault is None else result.fault.message,
            **settings,
        },
        events=list_events(result.configuration, (), result.fault),
        window=MeasuredWindow(
            "load",
            scenario.title,
            start,
            ticks,
            start * period_s,
            ticks * period_s,
            start == 0,
            tuple(lanes),
        ),
    )

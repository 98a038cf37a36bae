"""The state of a session as the API reports it."""

import math
from dataclasses import asdict

import numpy as np

from svsa.actuators.installed import find_mechanism
from svsa.actuators.signals import CHANNEL_NAMES
from svsa.control.gains import Gains
from svsa.hardware.session.session import BenchSession
from svsa.runs.definition.configuration import ArmSetup, Configuration
from svsa.runs.execution.arm_run import ArmRun
from svsa.runs.execution.run import Run
from svsa.runs.metrics.metrics import Metrics
from svsa.runs.records.recorder import Recorder
from svsa.runs.session.journal import Journal
from svsa.runs.session.session import Session
from svsa.simulation.plant.effects import find_preset
from svsa.simulation.plant.load_table import ScheduledLoad
from svsa.simulation.plant.loads.load import TIP
from svsa_server.leases.lease import ControlLease, asking
from svsa_server.leases.queue import ControlQueue
from svsa_server.runs.lanes import build_window, list_ended_windows, list_session_segments
from svsa_server.schemas.lab.actuator import summarize_actuator
from svsa_server.schemas.lab.gain import GainsState
from svsa_server.schemas.lab.lease import ControlState, QueueState, WaitingState
from svsa_server.schemas.lab.session import (
    CommandState,
    LoadState,
    SessionProgress,
    SessionState,
)
from svsa_server.schemas.lab.setting import ArmSetupState, ConfigurationState
from svsa_server.schemas.runs.fault import build_session_fault
from svsa_server.schemas.runs.lane import LaneState
from svsa_server.schemas.runs.run import RecordingState
from svsa_server.sessions.bench_state import build_bench_state
from svsa_server.sessions.excitation import build_excitation
from svsa_server.sessions.hosted import HostedSession


def build_progress(hosted: HostedSession, since_tick: int = 0) -> SessionProgress:
    """Build the fields of the session that change with time.

    Of the ended items only those that reach to `since_tick` are returned.
    """
    session = hosted.session
    run, pace = session.run, session.pace
    segments = list_session_segments(session, since_tick)
    timeline = session.journal.timeline
    load_window, joints = timeline.load_window, len(run.configuration.joints)
    return SessionProgress(
        status=session.status,
        run_number=session.journal.run_number,
        tick=run.tick,
        time_s=run.time_s,
        speed="max" if math.isinf(pace.speed) else pace.speed,
        real_time_factor=pace.real_time_factor,
        accumulated_delay_s=pace.accumulated_delay_s,
        fault=session.fault and build_session_fault(session.fault),
        window=build_window(timeline.window, run.period_s),
        load_window=load_window and build_window(load_window, run.period_s),
        lanes=[
            LaneState(
                lane=number + 1,
                joint=None if run.configuration.arm is None else 1 + number % joints,
                id=timeline.lane_ids[number],
                law=lane.law,
                name=segments[number][-1].name,
                segments=segments[number],
                **_summarize(session, number),
            )
            for number, lane in enumerate(run.configuration.lanes)
        ],
        payload_kg=_list_payloads(run),
        recording=_build_recording(session.journal.recorder),
        excitation=build_excitation(hosted.excitation),
        bench=build_bench_state(session) if isinstance(session, BenchSession) else None,
    )


def build_state(hosted: HostedSession, since_tick: int = 0) -> SessionState:
    """Build the complete state of the session; since_tick as for `build_progress`."""
    session = hosted.session
    run = session.run
    actuator, *other_actuators = (
        summarize_actuator(find_mechanism(joint.actuator)) for joint in run.configuration.joints
    )
    newest = session.journal.history.read_newest()
    return SessionState(
        **dict(build_progress(hosted, since_tick)),
        session=session.name,
        instance=hosted.instance,
        revision=hosted.revision,
        last_command=_build_last_command(session.journal),
        branch_of=session.journal.branch_of,
        note=hosted.note,
        exercise=hosted.before_exercise and hosted.before_exercise.exercise,
        control=build_control(hosted),
        queue=build_queue(hosted.lease),
        rate_hz=1.0 / run.period_s,
        actuator=actuator,
        other_actuators=other_actuators,
        configuration=_build_configuration(run.configuration),
        loads=[_build_load(load, run) for load in run.loads],
        events=[event for event in session.journal.events if event.tick >= since_tick],
        ended_windows=list_ended_windows(session, since_tick),
        sample=None if newest is None else _name_values(newest),
    )


def build_control(hosted: HostedSession) -> ControlState:
    """Describe the holder of the control lease, as the requesting client sees it."""
    lease = hosted.lease
    return ControlState(
        holder=lease.holder.name if lease.holder else None,
        mine=lease.is_held_by(asking.get()),
        watching=hosted.streams,
    )


def build_queue(lease: ControlLease) -> QueueState | None:
    """Describe the queue as the requesting client sees it; None if there is no queue."""
    if not isinstance(lease, ControlQueue):
        return None
    return QueueState(
        waiting=[WaitingState.model_validate(user) for user in lease.waiting],
        place=lease.find_place(asking.get()),
        locked=lease.is_locked,
        idle_s=lease.idle_s,
    )


def _build_last_command(journal: Journal) -> CommandState | None:
    for command in journal.commands[-1:]:
        time_s = command.tick * journal.run.period_s
        return CommandState(kind=command.kind, tick=command.tick, time_s=time_s)
    return None


def _build_recording(recorder: Recorder | None) -> RecordingState | None:
    if recorder is None:
        return None
    header = recorder.header
    return RecordingState(run_id=header.run_id, name=header.name, **asdict(recorder.status))


def _summarize(session: Session, lane: int) -> dict[str, Metrics | None]:
    metrics = session.journal.metrics
    kinds = {
        "since_start": metrics.since_start,
        "in_window": metrics.in_window,
        "since_load": metrics.since_load,
    }
    then = _find_lane_at_load(session, lane)
    places = {"since_start": lane, "in_window": lane, "since_load": then}
    running = {
        kind: None if lanes is None or (place := places[kind]) is None else lanes[place]
        for kind, lanes in kinds.items()
    }
    return {kind: window and _drop_unknown(window.summarize()) for kind, window in running.items()}


def _drop_unknown(metrics: Metrics | None) -> Metrics | None:
    """Return None for a lane that has ended, because its values would be outdated."""
    return None if metrics is None or math.isnan(metrics.rms_position_error_rad) else metrics


def _find_lane_at_load(session: Session, lane: int) -> int | None:
    """Find the lane that the current controller had at the onset of the load; None if none."""
    timeline = session.journal.timeline
    number = timeline.lanes[lane][-1].number
    return timeline.load_numbers.index(number) if number in timeline.load_numbers else None


def _list_payloads(run: Run) -> list[float] | None:
    if not isinstance(run, ArmRun) or run.configuration.require_arm().adaptation is None:
        return None
    return run.payloads_kg


def _build_arm(arm: ArmSetup | None) -> ArmSetupState | None:
    if arm is None:
        return None
    others = [_build_configuration(joint) for joint in arm.other_joints]
    return ArmSetupState(**{**dict(arm), "other_joints": others})


def _build_configuration(configuration: Configuration) -> ConfigurationState:
    own = {
        "gains": _build_gains(configuration.gains),
        "parameters": {
            law: parameters.model_dump(mode="json")
            for law, parameters in configuration.list_parameters().items()
        },
        "effects_preset": find_preset(configuration.effects),
        "arm": _build_arm(configuration.arm),
    }
    return ConfigurationState(**dict(configuration) | own)


def _build_gains(gains: Gains) -> GainsState:
    return GainsState(
        **dict(gains),
        position_roots_rad_per_s=gains.position_roots,
        stiffness_roots_rad_per_s=gains.stiffness_roots,
    )


def _build_load(scheduled: ScheduledLoad, run: Run) -> LoadState:
    is_on_joint = run.configuration.arm is not None and scheduled.load.acts_as != TIP
    return LoadState(
        id=scheduled.number,
        start_s=scheduled.start_tick * run.period_s,
        end_s=None if math.isinf(scheduled.end_tick) else scheduled.end_tick * run.period_s,
        active=scheduled.is_on(run.tick),
        label=scheduled.load.describe(),
        load=scheduled.load,
        joint=scheduled.joint if is_on_joint else None,
    )


def _name_values(row: np.ndarray) -> dict[str, float | None]:
    """Return a sample by channel; unknown values (NaN) are null."""
    pairs = zip(CHANNEL_NAMES, row.tolist(), strict=True)
    return {name: value if math.isfinite(value) else None for name, value in pairs}

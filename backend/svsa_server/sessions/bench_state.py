"""The state of a bench as the API reports it."""

import math

import numpy as np

from svsa.hardware.bench.homing import STEPS, Axis, get_instruction
from svsa.hardware.realtime.memory import LATENESS_EDGES_S, read_quantile
from svsa.hardware.safety.heat import compute_lasting_torque
from svsa.hardware.session.session import BenchSession
from svsa_server.schemas.hardware.bench import (
    BenchState,
    HomingState,
    LoopState,
    LoopStateName,
    MotorState,
)

_BINS_A_WIRE_BIN = 25


def build_bench_state(session: BenchSession) -> BenchState:
    """Build the current state of a session's bench."""
    fields, bench, calibration = session.loop.memory.fields, session.bench, session.calibration
    return BenchState(
        name=bench.name,
        emulated=session.emulated,
        status=session.bench_status.value,
        interface=f"{bench.bus.interface}, {bench.bus.channel}",
        calibrated_by=calibration.by if calibration else None,
        calibrated_on=calibration.date if calibration else None,
        problems=session.report.problems,
        homing=_build_homing(session.report.homing_step),
        current_a=tuple(fields["current_a"].tolist()) if _is_ticking(session) else None,
        motors=_build_motors(session) if _is_ticking(session) else None,
        ages_s=tuple(np.minimum(fields["ages_s"] + _find_silence_s(session), 1e3).tolist()),
        stale_zero_s=bench.safety.stale_zero_s,
        stale_fault_s=bench.safety.stale_fault_s,
        supervised=session.loop.supervised,
        operator_required=bench.safety.needs_watcher,
        dead_man=bench.safety.dead_man,
        loop=build_loop(session),
    )


def _build_motors(session: BenchSession) -> tuple[MotorState, MotorState]:
    fields = session.loop.memory.fields
    motor1, motor2 = (
        MotorState(
            heat=float(fields["heat"][number]),
            lasting_torque_nm=compute_lasting_torque(motor),
            allowed_torque_nm=float(fields["allowed_nm"][number]),
            limited_by_heat=bool(fields["is_limited_by_heat"][number]),
        )
        for number, motor in enumerate((session.bench.motor1, session.bench.motor2))
    )
    return motor1, motor2


def _build_homing(next_step: Axis | None) -> HomingState:
    names: list[Axis] = [step.name for step in STEPS]
    done = names[: names.index(next_step)] if next_step else names
    return HomingState(done=done, next_step=next_step, instruction=get_instruction(next_step))


def build_loop(session: BenchSession) -> LoopState:
    """Build state and timing of a bench's loop from its shared memory."""
    fields, loss = session.loop.memory.fields, session.loop.loss
    lateness = fields["lateness"].copy()
    p50, p99, p999 = (read_quantile(lateness, share) for share in (0.5, 0.99, 0.999))
    starts = np.arange(0, len(lateness), _BINS_A_WIRE_BIN)
    ends = np.minimum(starts + _BINS_A_WIRE_BIN, len(lateness)) - 1
    edges = np.minimum(LATENESS_EDGES_S[ends], 10.0)
    return LoopState(
        alive=_is_ticking(session),
        state=_name_state(session),
        step=session.loop.processes.step if session.loop.starting else None,
        starting_s=session.loop.processes.age_s if session.loop.starting else None,
        silent_s=(session.loop.processes.silence_s or None) if loss else None,
        stopped_by=loss.stopped_by if loss else None,
        unreachable=loss.problem if loss else None,
        rate_hz=1.0 / session.bench.timing.period_s,
        ticks=int(fields["ticks"]),
        skipped_ticks=int(fields["skipped"]),
        skipped_in_run=int(fields["skipped_in_run"]),
        lateness_p50_s=p50,
        lateness_p99_s=p99,
        lateness_p999_s=p999,
        lateness_worst_s=float(fields["worst_s"]),
        cost_p99_s=read_quantile(fields["cost"].copy(), 0.99),
        lateness_edges_s=edges.tolist(),
        lateness_counts=np.add.reduceat(lateness, starts).tolist(),
        notes=session.loop.processes.notes,
    )


def _is_ticking(session: BenchSession) -> bool:
    return session.loop.loss is None and not session.loop.starting


def _find_silence_s(session: BenchSession) -> float:
    """Return how much older the loop's last report is than it claims, s; infinite if unknown."""
    return 0.0 if _is_ticking(session) else session.loop.processes.silence_s or math.inf


def _name_state(session: BenchSession) -> LoopStateName:
    if session.loop.starting:
        return "starting"
    if session.loop.processes.failure is not None:
        return "not_opened"
    if session.loop.loss is None:
        return "ticking"
    return "silent" if session.loop.processes.alive else "gone"

"""The state of a bench in the API: its drives, its loop, and the allowed commands."""

from typing import Annotated, Literal

from pydantic import BaseModel, Field

from svsa.hardware.bench.homing import Axis
from svsa.hardware.realtime.loss import Stopper
from svsa.inputs.checked import Checked, quantity
from svsa_server.problems import ShownText

LoopStateName = Literal["ticking", "silent", "gone", "starting", "not_opened"]
BenchStatusName = Literal["off", "reset", "config", "mode", "ready", "run", "ramp", "fault"]


class HomingRequest(Checked):
    """Confirm that one axis is at its zero mark."""

    step: Axis = quantity("", "Axis at its mark: link, motor1 or motor2")
    by: Annotated[str, Field(min_length=1, max_length=100)] = quantity(
        "", "Name of the person at the mark"
    )


class HomingState(BaseModel):
    """The homing procedure: completed axes, and the instruction of the next step; null when
    done.
    """

    done: list[Axis]
    next_step: Axis | None
    instruction: str


class LoopState(BaseModel):
    """The loop's process: its timing statistics since the start."""

    alive: bool = Field(description="Whether the loop runs")
    state: LoopStateName = Field(
        description="silent: its process runs but has not ticked for 0.5 s. gone: its process has "
        "ended. starting: loop and supervisor are starting, and the bench accepts no "
        "command. not_opened: it did not become ready, and nothing has moved"
    )
    step: str | None = Field(description="Current step of the start; null otherwise")
    starting_s: float | None = Field(description="Time since the start began, s; null otherwise")
    silent_s: float | None = Field(
        description="Time since its last tick, s; null while it runs, or before the first tick"
    )
    stopped_by: Stopper | None = Field(
        description="Process that holds the drives at zero current instead; null while the loop"
        " runs, or if none does"
    )
    unreachable: str | None = Field(
        description="Why the server cannot stop the drives (disconnect the motor supply); null "
        "otherwise"
    )
    rate_hz: float
    ticks: int
    skipped_ticks: int = Field(description="Late ticks since the loop started")
    skipped_in_run: int = Field(description="Late ticks of the current run")
    lateness_p50_s: float = Field(description="Median since the loop started")
    lateness_p99_s: float
    lateness_p999_s: float
    lateness_worst_s: float
    cost_p99_s: float = Field(description="Duration of a tick: read, observe, decide, write")
    lateness_edges_s: list[float] = Field(description="Upper edges of the histogram's bins")
    lateness_counts: list[int]
    notes: list[str] = Field(description="Real-time settings that the system granted or denied")


class MotorState(BaseModel):
    """Temperature of a motor's winding by the I²t model, and the torque that it allows."""

    heat: float = Field(description="1 is the thermal limit; the torque is reduced from 0.9 on")
    lasting_torque_nm: float = Field(description="Continuous rating: the heat stays at 1")
    allowed_torque_nm: float = Field(description="Largest torque that heat allows now")
    limited_by_heat: bool = Field(
        description="Whether heat limits the torque, now or within the last 0.5 s"
    )


class BenchState(BaseModel):
    """The current state of a bench."""

    name: str
    emulated: bool | None = Field(
        description="Whether the bus has reported an emulator; null before the first message: treat"
        " it as a real bench"
    )
    status: BenchStatusName
    interface: str = Field(description="python-can's interface and channel")
    calibrated_by: str | None
    calibrated_on: str | None = Field(description="ISO 8601")
    problems: list[ShownText] = Field(
        description="Reasons why the bench cannot be armed; empty if it can"
    )
    homing: HomingState
    current_a: tuple[float, float] | None = Field(
        description="As reported by the drives; null if the loop does not run"
    )
    motors: tuple[MotorState, MotorState] | None = Field(
        description="Heat of motor 1 and motor 2; null if the loop does not run"
    )
    ages_s: tuple[float, float, float] = Field(description="Of motor 1, motor 2, deflection")
    stale_zero_s: float = Field(description="Above this age: zero torque")
    stale_fault_s: float = Field(description="Above this age: fault")
    supervised: bool = Field(description="Whether the supervisor's heartbeat is recent")
    operator_required: bool = Field(description="Whether a user must watch while the bench runs")
    dead_man: bool = Field(
        description="It runs only while a user holds the switch: any message on the stream of"
        " the user in control, every 0.1 s or as the bench file says"
    )
    loop: LoopState

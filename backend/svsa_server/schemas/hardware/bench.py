"""The state of a bench in the API: its drives, its loop, and the allowed commands."""

from typing import Annotated, Literal

from pydantic import BaseModel, Field

from svsa.hardware.homing import Axis
from svsa.hardware.realtime.loss import Stopper
from svsa.inputs.checked import Checked, quantity

LoopStateName = Literal["ticking", "silent", "gone", "starting", "not_opened"]
BenchStatusName = Literal["off", "reset", "config", "mode", "ready", "run", "ramp", "fault"]


class HomingRequest(Checked):
    """Confirm that one axis is at its zero mark."""

    step: Axis = quantity("", "Axis at its mark: link, motor1 or motor2")
    by: Annotated[str, Field(min_length=1, max_length=100)] = quantity("", "Who looked at the mark")


class HomingState(BaseModel):
    """The homing procedure: completed axes, and the instruction of the next step; null when
    done.
    """

    done: list[Axis]
    next_step: Axis | None
    instruction: str


class LoopState(BaseModel):
    """The loop's process: its timing statistics since the start."""

    alive: bool = Field(description="It ticks: its process is there, and not silent")
    state: LoopStateName = Field(
        description="silent: its process is there and has not ticked for 0.5 s. gone: its process"
        " has ended. starting: loop and supervisor are being started, and the bench takes no"
        " command. not_opened: it did not get ready, and has moved nothing"
    )
    step: str | None = Field(description="What it does while it is being started; null else")
    starting_s: float | None = Field(description="Since it is being started, s; null else")
    silent_s: float | None = Field(
        description="Since its last tick, s; null while it ticks, and where it has not"
    )
    stopped_by: Stopper | None = Field(
        description="Who keeps the drives at zero current in its place; null while it ticks, and"
        " if neither does"
    )
    unreachable: str | None = Field(
        description="Why the server cannot stop the drives: pull the motors' supply; else null"
    )
    rate_hz: float
    ticks: int
    skipped_ticks: int = Field(description="Since the loop started")
    skipped_in_run: int = Field(description="Of those the ones that the present run has missed")
    lateness_p50_s: float = Field(description="Half of the ticks since the loop started")
    lateness_p99_s: float
    lateness_p999_s: float
    lateness_worst_s: float
    cost_p99_s: float = Field(description="What a tick takes: read, observe, decide, write")
    lateness_edges_s: list[float] = Field(description="Upper edges of the histogram's bins")
    lateness_counts: list[int]
    notes: list[str] = Field(description="What of real time the system allowed, and what not")


class MotorState(BaseModel):
    """Temperature of a motor's winding by the I²t model, and the torque that it allows."""

    heat: float = Field(description="1 is the thermal limit; the torque is reduced from 0.9 on")
    lasting_torque_nm: float = Field(description="Continuous rating: the heat stays at 1")
    allowed_torque_nm: float = Field(description="The greatest torque that its heat allows now")
    held_back: bool = Field(
        description="More than that was asked for, now or within the last half second"
    )


class EnduranceState(BaseModel):
    """A motor that a load overheats: from when on heat limits its torque."""

    motor: Literal["motor1", "motor2"]
    torque_nm: float = Field(description="Asked for under the load, rms")
    lasting_torque_nm: float = Field(description="Continuous rating")
    seconds: float = Field(description="From the load's onset until it is held back, from cold")


class BenchState(BaseModel):
    """The present state of a bench."""

    name: str
    emulated: bool | None = Field(
        description="An emulator stands in for the bench, as the bus says; null before it has"
        " been listened to: take it for a real one"
    )
    status: BenchStatusName
    interface: str = Field(description="python-can's interface and channel")
    calibrated_by: str | None
    calibrated_on: str | None = Field(description="ISO 8601")
    problems: list[str] = Field(description="Why it does not arm; empty if it may")
    homing: HomingState
    current_a: tuple[float, float] | None = Field(
        description="As the drives say; null where no loop ticks that would hear them"
    )
    motors: tuple[MotorState, MotorState] | None = Field(
        description="Heat of motor 1 and motor 2; null where no loop ticks that would know it"
    )
    ages_s: tuple[float, float, float] = Field(description="Of motor 1, motor 2, deflection")
    stale_zero_s: float = Field(description="An age above it: zero torque")
    stale_fault_s: float = Field(description="An age above it: a fault")
    supervised: bool = Field(description="The supervisor's heartbeat is fresh")
    operator_required: bool = Field(description="A user must watch while it runs")
    dead_man: bool = Field(
        description="It runs only while a user holds the switch: any message on the stream of"
        " the user in control, every 0.1 s or as the bench file says"
    )
    loop: LoopState

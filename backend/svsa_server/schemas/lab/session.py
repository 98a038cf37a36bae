"""Requests and answers about sessions."""

from typing import Annotated, Literal

from pydantic import BaseModel, Field

from svsa.control.installed import PAPERS_LAW, InstalledLaw
from svsa.inputs.checked import Checked, Flag, Number, Whole, quantity
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.design import MAX_LANES, Design
from svsa.runs.definition.paper import get_figure
from svsa.runs.records.header import BranchPoint
from svsa.runs.timeline.events import Event
from svsa.simulation.plant.effects import IDEAL, Effects
from svsa.simulation.plant.loads import Load
from svsa_server.schemas.hardware.bench import BenchState
from svsa_server.schemas.lab.actuator import ActuatorSummary
from svsa_server.schemas.lab.law import InstalledLane
from svsa_server.schemas.lab.lease import ControlState, QueueState
from svsa_server.schemas.lab.setting import ConfigurationState
from svsa_server.schemas.runs.fault import SessionFault
from svsa_server.schemas.runs.lane import EndedWindowState, LaneState, WindowState
from svsa_server.schemas.runs.run import ExcitationState, RecordingState


class StepRequest(Checked):
    """The number of ticks to run."""

    ticks: Whole = quantity("ticks", "Control periods to run", ge=1, le=10_000, default=1)


class SpeedRequest(Checked):
    """The speed of session time."""

    speed: Annotated[Number, Field(ge=0.05, le=20)] | Literal["max"] = quantity(
        "1", "Session seconds per wall second, 0.05 to 20, or max for the maximum speed"
    )


class FigureRequest(Checked):
    """One of the paper's figures, optionally with other lanes and effects."""

    figure: Literal["4a", "4b", "5"] = quantity("", "Figure of the paper")
    law: InstalledLaw = quantity("", "Name of an installed law: see GET /laws", default=PAPERS_LAW)
    load: Flag = quantity("", "With the paper's 3 kg load at 5 s", default=True)
    comparisons: tuple[InstalledLane, ...] = quantity(
        "", "Comparison lanes, up to three", max_length=MAX_LANES - 1, default=()
    )
    effects: Effects = quantity("", "Non-ideal effects", default=IDEAL)

    def build_configuration(self, design: Design) -> Configuration:
        """Build the session's configuration with the lab's design.

        Raises:
            ParameterError: If a value is invalid.
        """
        figure = get_figure(self.figure).build_configuration(self.law, self.load, design)
        return figure.changed(comparisons=self.comparisons, effects=self.effects)


class LoadState(BaseModel):
    """A load of the session; `end_s` is null for a load without end."""

    id: int
    start_s: float
    end_s: float | None
    active: bool
    label: str = Field(description="The load in a few words")
    load: Load
    joint: int | None = Field(
        description="Joint of an arm on which the load acts; null for a load at the tip of an arm,"
        " and for a single joint"
    )


class AddedLoad(LoadState):
    """A load, and when it was added."""

    tick: int = Field(description="Tick at whose beginning the request takes effect")
    time_s: float


class CommandState(BaseModel):
    """A command, and when it took effect."""

    kind: str = Field(description="Changed setting, load, unload or stop")
    tick: int = Field(description="Tick at whose beginning it took effect")
    time_s: float


class SessionProgress(BaseModel):
    """The fields of a session that change with time: its time and its metrics."""

    status: Literal["running", "paused", "fault"]
    run_number: int = Field(
        description="Number of the run; incremented whenever a run starts at t = 0"
    )
    tick: int
    time_s: float
    speed: float | Literal["max"]
    real_time_factor: float = Field(description="Measured speed: session seconds per wall second")
    accumulated_delay_s: float = Field(description="Wall time skipped because ticks were late")
    fault: SessionFault | None = Field(description="Current fault, until reset or cleared")
    window: WindowState = Field(description="Current window: since the last change or load")
    load_window: WindowState | None = Field(
        description="From the newest load's onset to the next change; null without a load"
    )
    lanes: list[LaneState]
    payload_kg: list[float] | None = Field(
        description="Estimated mass at the tip of each arm; null without adaptive payload"
    )
    recording: RecordingState | None
    excitation: ExcitationState | None = Field(
        description="The identification excitation, while it is being played"
    )
    bench: BenchState | None = Field(description="Null for a simulated session")


class SessionState(SessionProgress):
    """A session: its time, its metrics and its settings."""

    session: str
    instance: str = Field(
        description="Unique id of the session; a new one after a restart of the server, or if a"
        " session is opened again under the same name"
    )
    revision: str = Field(description="Version of settings and loads, for If-Match")
    last_command: CommandState | None = Field(
        description="Newest change of a setting or load of this run; null before the first"
    )
    branch_of: BranchPoint | None = Field(description="Source of a branch; null otherwise")
    note: str = Field(
        description="Note given when the session was opened, such as why a law of the ranking"
        " has no comparison; empty without one"
    )
    exercise: str | None = Field(
        description="Name of the exercise that set up the session; null after"
        ' POST …/experiment {"from": "before_exercise"}, which restores the settings'
    )
    control: ControlState
    queue: QueueState | None = Field(
        description="Queue for control; null in a lab without a class, and in private sessions"
    )
    rate_hz: float
    actuator: ActuatorSummary
    other_actuators: list[ActuatorSummary] = Field(
        description="Actuators of the joints of an arm from the second on"
    )
    configuration: ConfigurationState
    loads: list[LoadState]
    events: list[Event]
    ended_windows: list[EndedWindowState] = Field(
        description="Ended windows of the last 60 s, the newest last, at most 50; without `window`"
    )
    sample: dict[str, float | None] | None = Field(
        description="Newest sample by channel; null if a bench does not know it"
    )

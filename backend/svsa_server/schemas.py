"""What goes over the wire besides the library's own values."""

from dataclasses import replace
from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import BaseModel, Field, create_model, model_validator

from svsa.checked import Checked, Flag, Number, Whole, quantity
from svsa.control.gains import FASTEST_POLE_RAD_PER_S, Gains, compute_coefficients
from svsa.control.installed import LawName
from svsa.errors import Fault, ParameterError, Violation
from svsa.experiment.paper import get_figure
from svsa.observer.disturbance import ObserverBandwidth
from svsa.parameters import ActuatorParameters, Limits
from svsa.plant.disturbances import Load
from svsa.plant.effects import IDEAL, Effects
from svsa.reference.trajectories import PositionReference, StiffnessReference
from svsa.runtime.configuration import MOST_LANES, Configuration, Design, Lane
from svsa.runtime.session import Event
from svsa_server.bench_schemas import BenchState
from svsa_server.control_schemas import ControlState
from svsa_server.lane_schemas import LaneMetrics, LaneState, WindowState
from svsa_server.run_schemas import Notes, RunName, Tags

LONGEST_PARAMETER_FILE = 100_000
_Part = Annotated[Number, Field(ge=-FASTEST_POLE_RAD_PER_S, le=FASTEST_POLE_RAD_PER_S)]
Pole = _Part | tuple[_Part, _Part]


class LawRequest(Checked):
    """Which law controls, and which the lanes beside; every plant stays where it is."""

    law: LawName = quantity("", "Name of a law that is installed")
    rival_laws: tuple[LawName, ...] = quantity(
        "",
        "Laws of the lanes beside, from the first on; those left out keep theirs",
        max_length=MOST_LANES - 1,
        default=(),
    )


class GainsRequest(Checked):
    """New gains, as poles or as coefficients of Eq 25; what is left out stays."""

    position_poles_rad_per_s: tuple[Pole, Pole, Pole, Pole] | None = quantity(
        "rad/s", "Four closed-loop poles of position, each a real part or [re, im]", default=None
    )
    stiffness_poles_rad_per_s: tuple[Pole, Pole] | None = quantity(
        "rad/s", "Two closed-loop poles of stiffness, each a real part or [re, im]", default=None
    )
    position_coefficients: tuple[Number, Number, Number, Number] | None = quantity(
        "s⁻⁴ … s⁻¹", "c0 … c3 of s⁴ + c3 s³ + c2 s² + c1 s + c0", default=None
    )
    stiffness_coefficients: tuple[Number, Number] | None = quantity(
        "s⁻², s⁻¹", "c0, c1 of s² + c1 s + c0", default=None
    )

    @model_validator(mode="after")
    def _check_once(self) -> Self:
        if not any(value is not None for _, value in self):
            bound = "poles or coefficients of position or stiffness"
            raise ParameterError(Violation("gains", {}, "", bound))
        for part in ("position", "stiffness"):
            poles = getattr(self, f"{part}_poles_rad_per_s")
            if poles is not None and getattr(self, f"{part}_coefficients") is not None:
                bound = f"left out where {part}_coefficients is given"
                raise ParameterError(Violation(f"{part}_poles_rad_per_s", list(poles), "", bound))
        return self

    def apply_to(self, gains: Gains) -> Gains:
        """The gains with these changes; raises `ParameterError` with the roots if unstable."""
        position, stiffness = self.choose_coefficients(gains)
        try:
            return Gains(position_coefficients=position, stiffness_coefficients=stiffness)
        except ParameterError as error:
            raise ParameterError(*map(self._call_as_given, error.violations)) from None

    def _call_as_given(self, violation: Violation) -> Violation:
        name = violation.name.replace("_coefficients", "_poles_rad_per_s")
        poles = getattr(self, name, None)
        if poles is None:
            return violation
        return replace(violation, name=name, value=list(poles), unit="rad/s")

    def choose_coefficients(
        self, gains: Gains
    ) -> tuple[tuple[float, float, float, float], tuple[float, float]]:
        """The coefficients asked for, or else those of `gains`, stable or not."""
        chosen: list[Any] = []
        for part, order in (("position", 4), ("stiffness", 2)):
            poles = getattr(self, f"{part}_poles_rad_per_s")
            coefficients = getattr(self, f"{part}_coefficients")
            if poles is not None:
                name = f"{part}_poles_rad_per_s"
                coefficients = compute_coefficients(name, [_read_pole(p) for p in poles], order)
            chosen.append(coefficients or getattr(gains, f"{part}_coefficients"))
        position, stiffness = chosen
        return position, stiffness


def _read_pole(pole: float | tuple[float, float]) -> complex:
    return complex(*pole) if isinstance(pole, tuple) else complex(pole)


class _Patch(Checked):
    """Changes to a section, which its errors name: two sections may have the same fields."""

    section: ClassVar[str] = ""

    def __init__(self, /, **values: Any) -> None:
        try:
            super().__init__(**values)
        except ParameterError as error:
            raise error.within(self.section) from None


def build_patch(section: str, model: type[ActuatorParameters]) -> type[Checked]:
    """`model` with every field left out at will, for PATCH; bounds, units and words stay.

    What is given must be a value: null would be refused by the model, and not silently kept.
    """
    fields: dict[str, Any] = {
        name: (field.annotation, field.merge_field_infos(field, default=None))
        for name, field in model.model_fields.items()
    }
    patch = create_model(f"{section.title()}Patch", __base__=_Patch, **fields)
    patch.section = section
    return patch


class LanesRequest(Checked):
    """The controllers beside the session's own."""

    rivals: tuple[Lane, ...] = quantity("", "Up to three", max_length=MOST_LANES - 1)


class StepRequest(Checked):
    """How far to go by hand."""

    ticks: Whole = quantity("ticks", "Control periods to run", ge=1, le=10_000, default=1)


class SpeedRequest(Checked):
    """How fast session time goes."""

    factor: Annotated[Number, Field(ge=0.05, le=20)] | Literal["max"] = quantity(
        "1", "Session seconds a wall second, 0.05 to 20, or max for as fast as it goes"
    )


class ExperimentRequest(Checked):
    """One of the paper's figures, from t = 0; with other lanes and effects than it has."""

    figure: Literal["4a", "4b", "5"] = quantity("", "Figure of the paper")
    law: LawName = quantity("", "Name of a law that is installed", default="ndobc")
    load: Flag = quantity("", "With the paper's 3 kg load at 5 s", default=True)
    rivals: tuple[Lane, ...] = quantity("", "Up to three", max_length=MOST_LANES - 1, default=())
    effects: Effects = quantity("", "What separates it from a bench", default=IDEAL)

    def build_configuration(self, design: Design) -> Configuration:
        """What the session is set to, with the lab's design; raises `ParameterError`."""
        figure = get_figure(self.figure).build_configuration(self.law, self.load, design)
        return figure.changed(rivals=self.rivals, effects=self.effects)


class SessionRequest(ExperimentRequest):
    """A private session: a figure of the paper to start from, and the seed of its noise."""

    figure: Literal["4a", "4b", "5"] = quantity("", "Figure of the paper", default="4a")
    seed: Whole = quantity("", "Seed of the sensor noise", ge=0, le=2**63 - 1, default=0)

    def build_configuration(self, design: Design) -> Configuration:
        """What the session is set to, with the lab's design; raises `ParameterError`."""
        return super().build_configuration(design).changed(seed=self.seed)


class RecordingRequest(Checked):
    """What a recording is called; all of it may be changed later."""

    name: RunName = quantity("", "Name of the run", default="")
    tags: Tags = quantity("", "Words to find it by, each once", default=())
    notes: Notes = quantity("", "Notes", default="")


class BranchRequest(Checked):
    """Where to go on from."""

    tick: Whole = quantity("ticks", "Tick of the recorded run, from its t = 0", ge=0, le=10**9)


class LoginRequest(Checked):
    """The shared secret."""

    secret: Annotated[str, Field(max_length=1000)] = quantity("", "The lab's shared secret")


class StreamRequest(Checked):
    """What a stream carries."""

    rate_hz: Number = quantity("Hz", "Samples a second", ge=1, le=10_000, default=200.0)
    lanes: tuple[Annotated[Whole, Field(ge=1, le=MOST_LANES)], ...] | None = quantity(
        "", "Numbers of the lanes, from 1; None is all there are", default=(1,)
    )
    history_s: Number = quantity("s", "Past to send first", ge=0, le=20, default=0.0)


class Root(BaseModel):
    """A root of Eq 25, rad/s."""

    re: float
    im: float


class GainsState(BaseModel):
    """The gains with the roots they give."""

    position_coefficients: list[float]
    stiffness_coefficients: list[float]
    position_roots_rad_per_s: list[Root]
    stiffness_roots_rad_per_s: list[Root]


class ConfigurationState(BaseModel):
    """Everything that is set."""

    law: str
    position: PositionReference
    stiffness: StiffnessReference
    gains: GainsState
    observer: ObserverBandwidth
    limits: Limits
    actuator: ActuatorParameters
    nominal: ActuatorParameters
    rivals: tuple[Lane, ...]
    effects: Effects
    seed: int


class LoadState(BaseModel):
    """A load of the session; `end_s` is null for one that stays."""

    id: int
    start_s: float
    end_s: float | None
    active: bool
    load: Load


class RecordingState(BaseModel):
    """How a recording stands; failed says why, and control goes on."""

    run_id: str
    name: str
    state: Literal["recording", "failed", "closed"]
    message: str
    ticks: int
    bytes: int


class ExcitationState(BaseModel):
    """How far the identification excitation has been played; it is recorded."""

    elapsed_s: float
    duration_s: float


class ExcitationRequest(Checked):
    """What the recording of the excitation is called."""

    name: RunName = quantity("", "Name of the run", default="Identification")


class ParameterFileRequest(Checked):
    """A parameter file as `svsa identify` writes it."""

    toml: Annotated[str, Field(max_length=LONGEST_PARAMETER_FILE)] = quantity(
        "", "The text of the file"
    )


class SessionProgress(BaseModel):
    """What of a session moves by itself: where it is and how well it does."""

    status: Literal["running", "paused", "fault"]
    run_number: int = Field(description="Counts up whenever a run begins anew at t = 0")
    tick: int
    time_s: float
    speed: float | Literal["max"]
    real_time_factor: float = Field(description="Session seconds a wall second, as measured")
    stretched_s: float = Field(description="Wall time given up because ticks came too late")
    fault: Fault | None
    window: WindowState = Field(description="Since the last change of anything, or the last load")
    load_window: WindowState | None = Field(
        description="From the newest load's onset to the next change; null where none came"
    )
    metrics: LaneMetrics = Field(description="Of lane 1")
    lanes: list[LaneState]
    recording: RecordingState | None
    excitation: ExcitationState | None = Field(
        description="The identification excitation, while it is being played"
    )
    bench: BenchState | None = Field(description="Null for a simulated session")


class BranchState(BaseModel):
    """The recorded run that a session goes on from, and the tick at which it left it."""

    run_id: str
    tick: int


class SessionState(SessionProgress):
    """A session: where it is, how well it does, and how it is set."""

    session: str
    branch_of: BranchState | None = Field(description="null unless its run is a branch")
    control: ControlState
    rate_hz: float
    configuration: ConfigurationState
    loads: list[LoadState]
    events: list[Event]
    sample: dict[str, float | None] | None = Field(
        description="The newest sample, by channel; null where a bench does not know it"
    )


class FigureState(BaseModel):
    """A figure of the paper as data."""

    key: str
    title: str
    position: PositionReference
    stiffness: StiffnessReference
    claim: str


class Health(BaseModel):
    """That the server lives."""

    status: Literal["ok"] = "ok"
    version: str

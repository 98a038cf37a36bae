"""A session of a lab, shared or private, simulated or on a bench."""

from collections.abc import Mapping
from contextlib import AbstractContextManager
from typing import Any, Literal

from pydantic import TypeAdapter

from svsa.actuators.installed import InstalledActuator
from svsa.actuators.parameters import MechanismParameters
from svsa.client.connection import Connection, Remote, SessionConnection, is_settable
from svsa.client.loads import Loads
from svsa.client.motion import RunningConnection
from svsa.client.runs import Recording, RemoteRuns
from svsa.client.stream import BlockStream
from svsa.control.gains import Gains
from svsa.control.law_names import AnyLaw
from svsa.control.observers.disturbance import ObserverBandwidth
from svsa.inputs.nearest import suggest
from svsa.runs.configuration import Lane
from svsa.runs.result.channels import ChannelName
from svsa.runs.shorthand import (
    GivenActuator,
    GivenEffects,
    GivenGains,
    GivenLanes,
    GivenObserver,
    GivenPosition,
    GivenStiffness,
    LawChoice,
    read_lane,
    read_setting,
)
from svsa.simulation.plant.effects import Effects
from svsa.simulation.reference.kinds import PositionReference, StiffnessReference

_POSITION: TypeAdapter[PositionReference] = TypeAdapter(PositionReference)
_STIFFNESS: TypeAdapter[StiffnessReference] = TypeAdapter(StiffnessReference)
_ACTUATOR: TypeAdapter[MechanismParameters] = TypeAdapter(InstalledActuator)


class RemoteSession(RunningConnection):
    """A session by its name; every property is read from the lab.

    Setting one returns when the lab has taken it, and `applied_at` says at which tick it holds;
    what is set already stays as it is, without a new fade or event. What the lab refuses raises
    `ParameterError` or `StateError` and changes nothing.
    """

    __slots__ = ("_runs", "bench", "loads")

    def __init__(self, connection: Connection, runs: RemoteRuns, name: str) -> None:
        super().__init__(connection, name)
        self._runs = runs
        self.loads = Loads(self)
        self.bench = RemoteBench(self)

    def __repr__(self) -> str:
        state = self.read_state()
        return (
            f"session {self.name}: {state['status']} at {state['time_s']:.3f} s,"
            f" {state['configuration']['law']}"
        )

    @property
    def status(self) -> Literal["running", "paused", "fault"]:
        """running, paused, or fault."""
        return self.read_state()["status"]

    @property
    def tick(self) -> int:
        """Present tick of the run, from t = 0."""
        return self.read_state()["tick"]

    @property
    def time_s(self) -> float:
        """Present time of the run, s."""
        return self.read_state()["time_s"]

    @property
    def sample(self) -> Mapping[str, float | None] | None:
        """Newest sample by channel, SI; None if a bench does not know it."""
        return self.read_state()["sample"]

    def _read(self, name: str) -> Any:
        return self.read_state()["configuration"][name]

    def get(self, name: str) -> Any:
        """Return a property by its name, such as "law" or "time_s".

        Raises:
            AttributeError: There is no such property.
        """
        known = [one for one in dir(type(self)) if isinstance(getattr(type(self), one), property)]
        if name not in known:
            raise AttributeError(f"A session has no property {name!r}{suggest(name, known)}.")
        return getattr(self, name)

    def set(self, **settings: Any) -> None:
        """Set properties in the given order; return when the last one is in effect.

        Args:
            **settings: Any properties that can be set, such as law="fl", each with its value.

        Raises:
            ParameterError, StateError: The lab rejects a value; what was set before it stays.
            TypeError: There is no such setting; nothing is set.
        """
        known = [one for one in dir(type(self)) if is_settable(type(self), one)]
        for name in settings:
            if name not in known:
                raise TypeError(f"A session has no setting {name!r}{suggest(name, known)}.")
        for name, value in settings.items():
            setattr(self, name, value)

    def _put(self, name: str, given: Any, method: str = "PUT") -> None:
        """Set a property to the value that `given` abbreviates."""
        present = getattr(self, name) if isinstance(given, Mapping) else None
        value = read_setting(name, given, present)
        self.call(method, f"/{name}", value.model_dump(mode="json", exclude={"mechanism"}))

    @property
    def position(self) -> PositionReference:
        """Reference q_d; a new one is faded in."""
        return _POSITION.validate_python(self._read("position"))

    @position.setter
    def position(self, reference: GivenPosition) -> None:
        self._put("position", reference)

    @property
    def stiffness(self) -> StiffnessReference:
        """Reference σ_d; a new one is faded in."""
        return _STIFFNESS.validate_python(self._read("stiffness"))

    @stiffness.setter
    def stiffness(self, reference: GivenStiffness) -> None:
        self._put("stiffness", reference)

    def repeat_position(self) -> None:
        """Restart the position reference, faded in; setting the same one would not restart it."""
        self.call("PUT", "/position?restart=true", self._read("position"))

    def repeat_stiffness(self) -> None:
        """Restart the stiffness reference, faded in."""
        self.call("PUT", "/stiffness?restart=true", self._read("stiffness"))

    @property
    def law(self) -> AnyLaw:
        """Law of the first lane."""
        return self._read("law")

    @law.setter
    def law(self, law: LawChoice) -> None:
        self.call("PUT", "/law", {"law": law})

    @property
    def gains(self) -> Gains:
        """Coefficients of Eq 25, for laws that use gains."""
        reported = self._read("gains")
        return Gains(**{name: tuple(reported[name]) for name in Gains.model_fields})

    @gains.setter
    def gains(self, gains: GivenGains) -> None:
        self._put("gains", gains)

    @property
    def observer(self) -> ObserverBandwidth:
        """Bandwidths of the disturbance observer."""
        return ObserverBandwidth.model_validate(self._read("observer"))

    @observer.setter
    def observer(self, observer: GivenObserver) -> None:
        self._put("observer", observer)

    @property
    def effects(self) -> Effects:
        """Non-ideal effects of the simulation."""
        return Effects.model_validate(self._read("effects"))

    @effects.setter
    def effects(self, effects: GivenEffects) -> None:
        self._put("effects", effects)

    @property
    def actuator(self) -> MechanismParameters:
        """The true plant of a simulation."""
        return _ACTUATOR.validate_python(self._read("actuator"))

    @actuator.setter
    def actuator(self, actuator: GivenActuator) -> None:
        self._put("actuator", actuator, "PATCH")

    @property
    def nominal(self) -> MechanismParameters:
        """The model that law and observer believe in."""
        return _ACTUATOR.validate_python(self._read("nominal"))

    @nominal.setter
    def nominal(self, nominal: GivenActuator) -> None:
        self._put("nominal", nominal, "PATCH")

    @property
    def comparisons(self) -> tuple[Lane, ...]:
        """The controllers of the comparison lanes, each on its own plant."""
        return tuple(Lane.model_validate(lane) for lane in self._read("comparisons"))

    @comparisons.setter
    def comparisons(self, comparisons: GivenLanes) -> None:
        lanes = read_setting("comparisons", comparisons, None)
        self.call("PUT", "/lanes", {"comparisons": [dump_lane(lane) for lane in lanes]})

    def set_lane(self, number: int, lane: Lane | LawChoice) -> None:
        """Change the controller of one comparison lane; number: from 2."""
        self.call("PUT", f"/lanes/{number}", dump_lane(read_lane(lane, "lane")))

    def set_laws(self, law: LawChoice, *comparison_laws: LawChoice) -> None:
        """Change the laws of the first lanes; every plant keeps its state."""
        self.call("PUT", "/law", {"law": law, "comparison_laws": comparison_laws})

    def set_parameters(self, law: str, **values: float) -> None:
        """Set parameters of a law that has its own; those left out keep their values."""
        self.call("PUT", "/parameters", {law: values})

    def record(self, name: str = "", tags: tuple[str, ...] = (), notes: str = "") -> Recording:
        """Record every sample and command from now on; as a context manager it stops at the end."""
        body = {"name": name, "tags": list(tags), "notes": notes}
        state = self.call("POST", "/recording", body)
        return Recording(self, self._runs, state["recording"]["run_id"])

    def excite(self, name: str = "Identification") -> Recording:
        """Play and record the excitation for `svsa identify`, 32 s."""
        state = self.call("POST", "/excitation", {"name": name})
        return Recording(self, self._runs, state["recording"]["run_id"])

    def stream(
        self,
        *channels: ChannelName,
        duration_s: float = float("inf"),
        rate_hz: float = 200.0,
        lanes: tuple[int, ...] | None = (1,),
        history_s: float = 0.0,
    ) -> BlockStream:
        """Stream samples; channels: by default those of the plots.

        duration_s: session time to return. rate_hz: samples a second at speed 1. lanes: their
        numbers, from 1; None is all there are. history_s: past to return first, up to 20 s.
        """
        query = {"rate_hz": f"{rate_hz:g}", "history_s": f"{history_s:g}"}
        query["lanes"] = "all" if lanes is None else ",".join(map(str, lanes))
        if channels:
            query["channels"] = ",".join(channels)
        return BlockStream(self.connection, self.name, query, duration_s)

    def watch(self) -> AbstractContextManager[None]:
        """Keep a stream open during the block; a bench requires one before it moves."""
        return self.stream(rate_hz=1.0).held_open()

    def end(self) -> None:
        """End the private session."""
        self.connection.call("DELETE", self.path)


class RemoteBench(Remote):
    """Commands of a bench; a simulated session raises `StateError`."""

    __slots__ = ("_session",)

    def __init__(self, session: SessionConnection) -> None:
        self._session = session

    @property
    def state(self) -> dict[str, Any] | None:
        """State of the bench; None for a simulated session."""
        return self._session.read_state()["bench"]

    def arm(self) -> None:
        """Reset the drives and bring them to current mode."""
        self._session.call("POST", "/bench/arm")

    def confirm_home(self, step: Literal["link", "motor1", "motor2"], by: str) -> None:
        """Confirm that an axis is at its zero mark; by: name of the observer."""
        self._session.call("POST", "/bench/home", {"step": step, "by": by})

    def clear(self) -> None:
        """Clear a latched fault; it must be armed again."""
        self._session.call("POST", "/bench/clear")

    def restart(self) -> None:
        """Restart loop and supervisor."""
        self._session.call("POST", "/bench/restart")


def dump_lane(lane: Lane) -> dict[str, Any]:
    """Convert a lane to a request."""
    return lane.model_dump(mode="json", exclude_none=True)

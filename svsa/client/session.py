"""A session of a lab, shared or private, simulated or on a bench."""

from collections.abc import Mapping
from contextlib import AbstractContextManager
from typing import Any, Literal
from urllib.parse import urlencode

from pydantic import BaseModel, TypeAdapter

from svsa.actuators.installed import InstalledActuator
from svsa.actuators.parameters import MechanismParameters
from svsa.client.bench import RemoteBench
from svsa.client.connection import Connection, is_settable
from svsa.client.loads import Loads
from svsa.client.motion import RunningConnection
from svsa.client.runs import Recording, RemoteRuns
from svsa.client.stream import BlockStream
from svsa.control.gains import Gains
from svsa.control.law_names import AnyLaw
from svsa.control.observers.disturbance import ObserverBandwidth
from svsa.control.observers.spring import SpringEstimation
from svsa.inputs.nearest import suggest
from svsa.runs.definition.design import Lane
from svsa.runs.definition.shorthand import (
    GivenActuator,
    GivenEffects,
    GivenGains,
    GivenLanes,
    GivenObserver,
    GivenPosition,
    GivenSpring,
    GivenStiffness,
    LawChoice,
    read_lane,
    read_setting,
)
from svsa.runs.result.channels import ChannelName
from svsa.simulation.plant.effects import Effects
from svsa.simulation.reference.kinds import PositionReference, StiffnessReference

_POSITION: TypeAdapter[PositionReference] = TypeAdapter(PositionReference)
_STIFFNESS: TypeAdapter[StiffnessReference] = TypeAdapter(StiffnessReference)
_ACTUATOR: TypeAdapter[MechanismParameters] = TypeAdapter(InstalledActuator)


class RemoteSession(RunningConnection):
    """A session by its name; every property is read from the lab.

    Setting a property returns when the lab has accepted it; `applied_at` is the tick at which it
    takes effect. Setting the current value changes nothing: no new transition or event. If the lab
    rejects a value, `ParameterError` or `StateError` is raised and nothing changes.
    """

    __slots__ = ("_joint", "_runs", "bench", "loads")

    def __init__(
        self, connection: Connection, runs: RemoteRuns, name: str, joint: int | None = None
    ) -> None:
        super().__init__(connection, name)
        self._runs = runs
        self._joint = joint
        self.loads = Loads(self, joint)
        self.bench = RemoteBench(self)

    def __repr__(self) -> str:
        state = self.read_state()
        return (
            f"session {self.name}: {state['status']} at {state['time_s']:.3f} s,"
            f" {state['configuration']['law']}"
        )

    @property
    def status(self) -> Literal["running", "paused", "fault"]:
        """State of the session: running, paused, or fault."""
        return self.read_state()["status"]

    @property
    def tick(self) -> int:
        """Current tick of the run, from t = 0."""
        return self.read_state()["tick"]

    @property
    def time_s(self) -> float:
        """Current time of the run, s."""
        return self.read_state()["time_s"]

    @property
    def sample(self) -> Mapping[str, float | None] | None:
        """Newest sample by channel, SI; None if a bench does not know it."""
        return self.read_state()["sample"]

    def _read(self, name: str) -> Any:
        configuration = self.read_state()["configuration"]
        if self._joint is not None and self._joint > 1:
            configuration = configuration["arm"]["other_joints"][self._joint - 2]
        return configuration[name]

    def _change(self, method: str, path: str, body: Any, **query: str) -> None:
        """Change a setting of the joint, or of all joints of an arm."""
        query |= {} if self._joint is None else {"joint": str(self._joint)}
        self.call(method, f"{path}?{urlencode(query)}" if query else path, body)

    def open_joint(self, number: int) -> "RemoteSession":
        """Return the session of an arm for the settings and torques of one joint.

        Args:
            number: Number of the joint.

        Returns:
            The same session; its settings are those of the joint.
        """
        return RemoteSession(self.connection, self._runs, self.name, number)

    def change_arm(self, **fields: Any) -> None:
        """Change the arm of the session; omitted fields are unchanged.

        Feedforward and adaptation act at once; tip, links and model restart the run at t = 0.

        Args:
            **fields: feedforward, adaptation, tip, links, model, as in `svsa.ArmSetup`.

        Raises:
            ParameterError: If a value is invalid.
            StateError: If the session is of a single joint.
        """
        written = {
            name: value.model_dump(mode="json") if isinstance(value, BaseModel) else value
            for name, value in fields.items()
        }
        self.call("PATCH", "/arm", written)

    def get(self, name: str) -> Any:
        """Return a property by its name.

        Args:
            name: Name of a property, such as "law" or "time_s".

        Returns:
            The value of the property.

        Raises:
            AttributeError: If there is no such property.
        """
        kind = type(self)
        known = [key for key in dir(kind) if isinstance(getattr(kind, key), property)]
        if name not in known:
            raise AttributeError(f"A session has no property {name!r}{suggest(name, known)}.")
        return getattr(self, name)

    def set(self, **settings: Any) -> None:
        """Set properties in the given order; return when the last one is in effect.

        Args:
            **settings: Any properties that can be set, such as law="fl", each with its value.

        Raises:
            ParameterError, StateError: If the lab rejects a value; earlier ones stay set.
            TypeError: If there is no such setting; nothing is set.
        """
        known = [attribute for attribute in dir(type(self)) if is_settable(type(self), attribute)]
        for name in settings:
            if name not in known:
                raise TypeError(f"A session has no setting {name!r}{suggest(name, known)}.")
        for name, value in settings.items():
            setattr(self, name, value)

    def _put(self, name: str, written: Any, method: str = "PUT") -> None:
        """Set a property to the value that `written` abbreviates."""
        present = getattr(self, name) if isinstance(written, Mapping) else None
        value = read_setting(name, written, present)
        self._change(method, f"/{name}", value.model_dump(mode="json", exclude={"mechanism"}))

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
        self._change("PUT", "/position", self._read("position"), restart="true")

    def repeat_stiffness(self) -> None:
        """Restart the stiffness reference, faded in."""
        self._change("PUT", "/stiffness", self._read("stiffness"), restart="true")

    @property
    def law(self) -> AnyLaw:
        """Law of the first lane."""
        return self._read("law")

    @law.setter
    def law(self, law: LawChoice) -> None:
        self._change("PUT", "/law", {"law": law})

    @property
    def gains(self) -> Gains:
        """Coefficients of Eq 25, for laws that use gains."""
        coefficients = self._read("gains")
        return Gains(**{name: tuple(coefficients[name]) for name in Gains.model_fields})

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
    def spring(self) -> SpringEstimation:
        """The spring estimator."""
        return SpringEstimation.model_validate(self._read("spring"))

    @spring.setter
    def spring(self, spring: GivenSpring) -> None:
        self._put("spring", spring)

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
        """The nominal model of law and observer."""
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
        """Change the controller of one comparison lane.

        Args:
            number: Number of the lane, from 2.
            lane: The controller, or the name of its law.
        """
        self._change("PUT", f"/lanes/{number}", dump_lane(read_lane(lane, "lane")))

    def set_laws(self, law: LawChoice, *comparison_laws: LawChoice) -> None:
        """Change the laws of the first lanes; every plant keeps its state.

        Args:
            law: Law of lane 1.
            *comparison_laws: Laws of the comparison lanes, in order. Other lanes keep their laws.
        """
        self._change("PUT", "/law", {"law": law, "comparison_laws": comparison_laws})

    def set_parameters(self, law: str, **values: float) -> None:
        """Set parameters of a law that has its own; omitted ones keep their values.

        Args:
            law: Name of the law.
            **values: Values by parameter name, in the units of the law's description.
        """
        self._change("PUT", "/parameters", {law: values})

    def record(self, name: str = "", tags: tuple[str, ...] = (), notes: str = "") -> Recording:
        """Record every sample and command from now on.

        Args:
            name: Name of the run; by default its settings.
            tags: Tags of the run.
            notes: Notes of the run.

        Returns:
            The recording; as a context manager it stops at the end of the block.
        """
        body = {"name": name, "tags": list(tags), "notes": notes}
        state = self.call("POST", "/recording", body)
        return Recording(self, self._runs, state["recording"]["run_id"])

    def excite(self, name: str = "Identification") -> Recording:
        """Play and record the excitation for `svsa identify`, 32 s.

        Args:
            name: Name of the recorded run.

        Returns:
            The recording.
        """
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
        """Stream samples.

        Args:
            *channels: Names of channels; by default those of the plots.
            duration_s: Session time to return, s.
            rate_hz: Samples per second of session time, Hz.
            lanes: Numbers of the lanes, from 1; None for all lanes.
            history_s: Past to return first, up to 20 s.

        Returns:
            An iterator over blocks of samples, SI units.
        """
        query = {"rate_hz": f"{rate_hz:g}", "history_s": f"{history_s:g}"}
        query["lanes"] = "all" if lanes is None else ",".join(map(str, lanes))
        if channels:
            query["channels"] = ",".join(channels)
        return BlockStream(self.connection, self.name, query, duration_s)

    def watch(self) -> AbstractContextManager[None]:
        """Keep a stream open during the block; a bench requires one before it moves.

        Returns:
            A context manager.
        """
        return self.stream(rate_hz=1.0).held_open()

    def end(self) -> None:
        """End the private session."""
        self.connection.call("DELETE", self.path)


def dump_lane(lane: Lane) -> dict[str, Any]:
    """Convert a lane to a request."""
    return lane.model_dump(mode="json", exclude_none=True)

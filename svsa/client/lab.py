"""A lab at an address: shared session, private sessions, recorded runs."""

import inspect
import os
from collections.abc import Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, contextmanager, suppress
from typing import Any, Self, Unpack

from svsa.client.connection import Connection, LabError, Remote
from svsa.client.runs import RemoteRuns, RemoteStudies
from svsa.client.session import RemoteSession, dump_lane
from svsa.control.law_names import AnyLaw
from svsa.errors import FaultError, ParameterError, Violation
from svsa.inputs.checked import check_number
from svsa.runs.definition.change import Change
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.paper import DURATION_S, Figure, get_figure, get_simulated_figure
from svsa.runs.definition.shorthand import LawChoice, Settings, change_configuration, read_setting
from svsa.runs.result.result import Result
from svsa.runs.result.simulate import MAX_TICKS

SHARED = "lab"
_SET_ALONE = (
    "position", "stiffness", "gains", "observer", "spring", "actuator", "nominal", "effects",
)  # fmt: skip


def connect(
    url: str = "http://127.0.0.1:8000",
    token: str | None = None,
    *,
    client: str = "",
    timeout_s: float = 30.0,
) -> "Lab":
    """Connect to a running lab. As a context manager it closes the connection.

    Args:
        url: Address of the lab.
        token: Token of a class, or the lab's shared secret; by default that of the environment
            (SVSA_SECRET).
        client: Id of this script in the lab; random by default.
        timeout_s: Time for which requests are repeated while the lab does not answer or is busy, s.

    Returns:
        The lab, with its sessions, runs and jobs.

    Raises:
        LabError: If no lab answers at this address.
    """
    connection = Connection(url, token or os.environ.get("SVSA_SECRET"), client, timeout_s)
    try:
        connection.read("/laws")
    except BaseException:
        connection.close()
        raise
    return Lab(connection)


class Lab(Remote):
    """A running lab over its public API.

    Attributes:
        session: The shared session, with the bench if there is one.
        runs: Recorded runs of the lab.
        studies: Studies of the lab.
    """

    __slots__ = ("connection", "runs", "session", "studies")

    def __init__(self, connection: Connection) -> None:
        self.connection = connection
        self.runs = RemoteRuns(connection)
        self.studies = RemoteStudies(connection)
        self.session = self.open_session(SHARED)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"lab at {self.connection.url}"

    def close(self) -> None:
        """Close the connection; sessions and recordings of the lab continue."""
        self.runs.close()
        self.connection.close()

    @property
    def actuators(self) -> tuple[str, ...]:
        """Names of the actuators that are installed there, the SVSA first."""
        return tuple(actuator["name"] for actuator in self.connection.read("/actuators"))

    @property
    def laws(self) -> tuple[str, ...]:
        """Names of the laws that are installed in the lab."""
        return tuple(law["name"] for law in self.connection.read("/laws"))

    def open_session(self, name: str) -> RemoteSession:
        """Return the session of this name.

        Args:
            name: Name of the session. The first request checks whether it exists.

        Returns:
            The session.
        """
        return RemoteSession(self.connection, self.runs, name)

    def create_session(
        self,
        figure: str = "4a",
        law: LawChoice = "ndobc",
        actuator: str | None = None,
        arm: str | None = None,
        **settings: Any,
    ) -> RemoteSession:
        """Open a private simulated session, running; it ends automatically when unused.

        Args:
            figure: Figure of the paper; must be omitted with `actuator` and `arm`.
            law: Name of the control law.
            actuator: Name of an actuator, such as "qbmove": its default experiment.
            arm: Name of an arm, such as "rods": its default experiment.
            **settings: load, comparisons, effects, seed, as for `POST /sessions`; for an actuator
                also parameters and nominal, for an arm actuators, feedforward and tip. A preset of
                effects and a law may be given by name.

        Returns:
            The session.

        Raises:
            LabError: If the lab rejects the request.
        """
        request = _write_experiment(figure, law, settings)
        sources = {"actuator": actuator, "arm": arm}
        for source, name in sources.items():
            if name is not None:
                request.pop("figure", None)
                request |= {"from": source, source: name}
        state = self.connection.call("POST", "/sessions", request)
        return self.open_session(state["session"])

    @contextmanager
    def new_session(
        self, figure: str = "4a", law: LawChoice = "ndobc", **settings: Any
    ) -> Iterator[RemoteSession]:
        """Open a private session that ends with the block.

        Args:
            figure: Figure of the paper.
            law: Name of the control law.
            **settings: As for `create_session`.

        Yields:
            The session.
        """
        session = self.create_session(figure, law, **settings)
        try:
            yield session
        except BaseException:
            with suppress(LabError):  # the first error is the one to report
                session.end()
            raise
        session.end()

    @contextmanager
    def operate(
        self, figure: str = "4a", law: LawChoice = "ndobc", **settings: Any
    ) -> Iterator[RemoteSession]:
        """Set up the shared session at rest at t = 0, and release it after the block.

        Requests control of the session, and in a class waits in the queue like a user. A bench
        stays armed and homed, and this script keeps a stream open while the block lasts. The bench
        moves from the first `run_until` on: an operator must watch it on site.

        Args:
            figure: Figure of the paper.
            law: Name of the control law.
            **settings: load, comparisons, effects.

        Yields:
            The shared session.
        """
        session = self.session
        session.take_control()
        try:
            session.come_to_rest()
            request = _write_experiment(figure, law, settings) | {"start": False}
            session.call("POST", "/experiment", request)
            with session.watch():
                yield session
                session.come_to_rest()
        finally:
            session.pause()
            session.give_control_back()

    def experiment(
        self, shared: bool, seed: int = 0, **settings: Any
    ) -> AbstractContextManager[RemoteSession]:
        """Call `operate` or `new_session`.

        Args:
            shared: Whether to use the shared session, which has its own noise.
            seed: Seed of the noise of a private session.
            **settings: As for `operate` and `new_session`.

        Returns:
            A context manager of the session.
        """
        return self.operate(**settings) if shared else self.new_session(seed=seed, **settings)

    def run(
        self,
        experiment: str | Figure | Configuration = "4a",
        law: LawChoice | None = None,
        *,
        duration_s: float = DURATION_S,
        commands: Sequence[Change] = (),
        name: str = "",
        **changes: Unpack[Settings],
    ) -> Result:
        """Simulate a run in the lab, record it there, and return it like `svsa.simulate`.

        The samples are bit-identical to those of `svsa.simulate`.

        Args:
            experiment: A figure of the paper, or a `Configuration`.
            law: Name of an installed law.
            duration_s: Duration of the run, s.
            commands: Changes during the run.
            name: Name of the recorded run.
            **changes: Fields of the configuration to replace, as for `svsa.simulate`.

        Returns:
            Samples and metrics of the run. A run that leaves the domain of the model ends early:
            see `Result.fault`.

        Raises:
            ParameterError: If a value is out of range, or limits or sampling differ from those of
                the lab.
        """
        if isinstance(experiment, str):
            experiment = get_simulated_figure(experiment)
        if isinstance(experiment, Figure):
            experiment = experiment.build_configuration()
        named = {} if law is None else {"law": law}
        keywords = inspect.signature(self.run).parameters
        configuration = change_configuration(experiment, {**changes, **named}, keywords)
        period = configuration.sampling.period_s
        check_number("duration_s", duration_s, "s", period, MAX_TICKS * period)
        comparisons = [dump_lane(lane) for lane in configuration.comparisons]
        with self.new_session(
            law=AnyLaw(configuration.law),
            load=False,
            comparisons=comparisons,
            seed=configuration.seed,
        ) as session:
            session.pause()
            _check_fixed(session, configuration)
            for setting in _SET_ALONE:
                setattr(session, setting, getattr(configuration, setting))
            for owner, parameters in configuration.parameters.items():
                session.set_parameters(owner, **parameters.model_dump(mode="json"))
            session.reset()
            for load in configuration.loads:
                session.loads.add(load)
            recording = session.record(name)
            try:
                for change in sorted(commands, key=lambda change: change.at_s):
                    check_number("at_s", change.at_s, "s", 0.0, duration_s)
                    session.run_until(change.at_s)
                    _give(session, change)
                session.run_until(duration_s)
            except FaultError:
                pass  # as in `simulate`, the result reports the fault
            finally:
                recording.stop()
            return recording.result


def _write_experiment(figure: str, law: str, settings: Mapping[str, Any]) -> dict[str, Any]:
    """Convert an experiment to a request."""
    written = {"figure": get_figure(figure).key, "law": law, **settings}
    if "effects" in settings and settings["effects"] is not None:
        effects = read_setting("effects", settings["effects"], None)
        written["effects"] = effects.model_dump(mode="json")
    if "comparisons" in settings:
        lanes = read_setting("comparisons", settings["comparisons"], None)
        written["comparisons"] = [dump_lane(lane) for lane in lanes]
    return written


def _check_fixed(session: RemoteSession, configuration: Configuration) -> None:
    """Raise `ParameterError` if a run has limits or a period that the lab does not have."""
    state = session.read_state()
    limits = configuration.limits.model_dump(mode="json")
    for name, value in state["configuration"]["limits"].items():
        if value != limits[name]:
            raise ParameterError(
                Violation(f"limits.{name}", limits[name], "", f"{value}, as in the lab")
            )
    if abs(state["rate_hz"] * configuration.sampling.period_s - 1.0) > 1e-9:
        period = 1.0 / state["rate_hz"]
        bound = f"{period:g} s, as in the lab"
        raise ParameterError(
            Violation("sampling.period_s", configuration.sampling.period_s, "s", bound)
        )


def _give(session: RemoteSession, change: Change) -> None:
    """Apply changes as requests; a reference that is already followed restarts."""
    if change.load is not None:
        session.loads.add(change.load)
    for law, parameters in (change.parameters or {}).items():
        session.set_parameters(law, **parameters.model_dump(mode="json"))
    for kind, value in change.list_given().items():
        if kind == "position" and value == session.position:
            session.repeat_position()
        elif kind == "stiffness" and value == session.stiffness:
            session.repeat_stiffness()
        elif kind not in ("load", "parameters"):
            setattr(session, kind, value)

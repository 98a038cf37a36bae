"""Sources of a session: a figure, run, falsification, scenario or exercise."""

from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field
from typing_extensions import TypeAliasType

from svsa.control.installed import PAPERS_LAW, InstalledLaw
from svsa.evaluation.falsifier.scenario import LoadScenario
from svsa.inputs.checked import Checked, Flag, Whole, quantity
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.design import MAX_LANES, Design, Lane
from svsa.runs.definition.experiment import build_actuator_experiment
from svsa.simulation.plant.effects import IDEAL, Effects
from svsa_server.access.owned import Owned
from svsa_server.schemas.lab.arm import FromArm
from svsa_server.schemas.lab.law import InstalledLane
from svsa_server.schemas.lab.session import FigureRequest
from svsa_server.schemas.lab.stability import DesignRequest
from svsa_server.schemas.teaching.course import StepName

PartOfParameters = Annotated[dict[str, float | str], Field(max_length=20)]


class FromFigure(FigureRequest):
    """A figure of the paper, running; the default if `from` is omitted."""

    source: Literal["figure"] = quantity("", "A figure", alias="from", default="figure")
    figure: Literal["4a", "4b", "5"] = quantity("", "Figure of the paper", default="4a")
    seed: Whole = quantity("", "Seed of the sensor noise", ge=0, le=2**63 - 1, default=0)

    def build_configuration(self, design: Design) -> Configuration:
        """Build the session's configuration with the lab's design.

        Raises:
            ParameterError: If a value is invalid.
        """
        return super().build_configuration(design).changed(seed=self.seed)


class FromActuator(Checked):
    """An actuator's default experiment, running: a sine, its default stiffness and load.

    Gains and observer are the actuator's defaults. See `GET /actuators` for names and parameters.
    """

    source: Literal["actuator"] = quantity("", "An actuator", alias="from")
    actuator: Annotated[str, Field(max_length=40)] = quantity("", "Name of an installed actuator")
    parameters: PartOfParameters = quantity(
        "", "Parameters of the plant that replace those of the prototype", default={}
    )
    nominal: PartOfParameters = quantity(
        "", "Parameters of the nominal model that replace its defaults", default={}
    )
    law: InstalledLaw = quantity("", "Name of an installed law: see GET /laws", default=PAPERS_LAW)
    load: Flag = quantity("", "Whether the default load acts from 5 s on", default=True)
    comparisons: tuple[InstalledLane, ...] = quantity(
        "", "Comparison lanes, up to three", max_length=MAX_LANES - 1, default=()
    )
    effects: Effects = quantity(
        "", "Effects of a real bench that the simulation includes", default=IDEAL
    )
    seed: Whole = quantity("", "Seed of the sensor noise", ge=0, le=2**63 - 1, default=0)

    def build_configuration(self) -> Configuration:
        """Build the session's configuration.

        Raises:
            ParameterError: If a value is invalid.
        """
        experiment = build_actuator_experiment(
            self.actuator, self.law, self.load, self.parameters, self.nominal
        )
        return experiment.changed(
            comparisons=self.comparisons, effects=self.effects, seed=self.seed
        )


class FromRun(Checked):
    """A recorded run at a tick, paused: the session continues it."""

    source: Literal["run"] = quantity("", "A recorded run", alias="from")
    id: Annotated[str, Owned("run")] = quantity("", "Id of the run")
    tick: Whole = quantity("ticks", "Tick of the recorded run, from its t = 0", ge=0, le=10**9)


class FromSession(DesignRequest):
    """Another session's settings with this design, stable or not; 3 kg are added after 1 s.

    It is a simulation even if the other session has a bench; the other session is not changed.
    """

    source: Literal["session"] = quantity("", "Another session", alias="from")
    id: Annotated[str, Owned("session")] = quantity("", "Name of the session")


class FromFalsification(Checked):
    """The scenario found by a falsification, running, with its law and another one."""

    source: Literal["falsification"] = quantity("", "A falsification", alias="from")
    id: Annotated[str, Owned("job")] = quantity("", "Id of the finished job")


class FromScenario(Checked):
    """A scenario, running, with up to four laws in parallel."""

    source: Literal["scenario"] = quantity("", "A scenario", alias="from")
    scenario: LoadScenario = quantity("", "Loads and settings")
    laws: Annotated[tuple[InstalledLaw, ...], Field(min_length=1, max_length=MAX_LANES)] = quantity(
        "", "Laws; the first one controls lane 1"
    )

    def build_configuration(self) -> Configuration:
        """Build the run's configuration.

        Raises:
            ParameterError: If it does not fit the base experiment.
        """
        law, *others = self.laws
        comparisons = tuple(Lane(law=other) for other in others)
        return self.scenario.build_configuration(law).changed(comparisons=comparisons)


class FromRanking(Checked):
    """A row of the ranking in a scenario, running, compared with NDOBC (declared gains).

    NDOBC itself is compared with FL. Without comparison if that would end earlier; `note` has the
    reason.
    """

    source: Literal["ranking"] = quantity("", "The ranking", alias="from")
    row: Annotated[str, Field(max_length=64)] = quantity(
        "", "Key of a row: a law's name, or ndobc_declared"
    )
    scenario: Annotated[str, Field(max_length=60)] = quantity(
        "", "Name of the run: rig_4a.negative.0, or trial_A_12"
    )


def _add_source(request: Any) -> Any:
    return {"from": "figure", **request} if isinstance(request, dict) else request


SessionRequest = TypeAliasType(
    "SessionRequest",
    Annotated[
        FromFigure
        | FromActuator
        | FromArm
        | FromRun
        | FromSession
        | FromFalsification
        | FromScenario
        | FromRanking,
        Field(discriminator="source"),
        BeforeValidator(_add_source),
    ],
)
"""A named type, because for a plain `Annotated` FastAPI applies the discriminator first."""


class FigureExperiment(FigureRequest):
    """One of the paper's figures, from t = 0; the default if `from` is omitted.

    Settings come from the figure; lanes and effects from the request. A bench has its own.
    """

    source: Literal["figure"] = quantity("", "A figure", alias="from", default="figure")
    start: Flag = quantity("", "Run immediately; otherwise paused at t = 0", default=True)


class ExerciseExperiment(Checked):
    """An experiment of the course, paused at t = 0; its predictions become final.

    A bench has its own plant, effects and limits: it gets law, references, loads, gains and
    observer. Rejected if a prediction is missing, on a bench that moves, or on a bench for a step
    that is a simulation only.
    """

    source: Literal["exercise"] = quantity("", "The course", alias="from")
    exercise: StepName = quantity("", "Name of the exercise")
    step: StepName = quantity("", "Name of the step")


class SettingsBeforeExercise(Checked):
    """The settings from before the exercise, from t = 0; running if the simulation ran then.

    A bench stays at rest. Rejected if no exercise has set up the session, or on a bench that moves.
    """

    source: Literal["before_exercise"] = quantity("", "Before the exercise", alias="from")


ExperimentRequest = TypeAliasType(
    "ExperimentRequest",
    Annotated[
        FigureExperiment | ExerciseExperiment | SettingsBeforeExercise,
        Field(discriminator="source"),
        BeforeValidator(_add_source),
    ],
)

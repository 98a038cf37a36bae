"""A scenario: a named run that any law can control."""

from typing import NamedTuple

from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.paper import FIGURES, LOAD_TIME_S
from svsa.simulation.plant.effects import RIG, Effects
from svsa.simulation.plant.loads import Load
from svsa.simulation.reference.kinds import PositionReference, StiffnessReference

TrueOverNominal = tuple[tuple[str, float], ...]
"""True over nominal value by name of the field of `ActuatorParameters`."""
INERTIAS = ("link_inertia_kg_m2", "motor1_inertia_kg_m2", "motor2_inertia_kg_m2")


class Scenario(NamedTuple):
    """A figure of the paper with other references, loads, effects and plant.

    Attributes:
        name: Key, unique within its set.
        title: The scenario in words.
        loads: Loads on link and motors.
        effects: Non-ideal effects of plant and sensors.
        duration_s: Duration of the run, s.
        measured_s: Time at which measuring begins, s.
        position: q_d; None for the figure's.
        stiffness: σ_d; None for the figure's.
        plant: Ratios of the plant to the nominal model.
        seed: Seed of the sensor noise.
        figure: Key of the figure.
    """

    name: str
    title: str
    loads: tuple[Load, ...] = ()
    effects: Effects = RIG
    duration_s: float = 20.0
    measured_s: float = LOAD_TIME_S
    position: PositionReference | None = None
    stiffness: StiffnessReference | None = None
    plant: TrueOverNominal = ()
    seed: int = 0
    figure: str = "4a"

    def build_configuration(self, law: str) -> Configuration:
        """Build the run of this scenario under a law with its default parameters."""
        figure = FIGURES[self.figure].build_configuration(law, load=False)
        actuator = figure.actuator
        if self.plant:
            nominal = figure.nominal
            ratios = {name: ratio * getattr(nominal, name) for name, ratio in self.plant}
            actuator = nominal.changed(**ratios)
        return figure.changed(
            position=self.position or figure.position,
            stiffness=self.stiffness or figure.stiffness,
            actuator=actuator,
            effects=self.effects,
            loads=self.loads,
            seed=self.seed,
        )

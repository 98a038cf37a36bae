"""The training runs: what a law is tuned on, and not judged by.

Five runs with the rig's effects, none of which stands in the ranking's table: soft and stiff,
models that are wrong by half, friction, noise, and loads that come, go, swing and hang.
"""

from typing import NamedTuple

from svsa.runs.configuration import Configuration
from svsa.runs.paper import FIGURES
from svsa.simulation.plant.effects import RIG, Effects
from svsa.simulation.plant.effects.friction import Friction
from svsa.simulation.plant.effects.noise import SensorNoise
from svsa.simulation.plant.loads import Load
from svsa.simulation.plant.loads.constant import ConstantLoad
from svsa.simulation.plant.loads.mass import MassLoad
from svsa.simulation.plant.loads.paper import PaperLoad
from svsa.simulation.plant.loads.pulse import PulseLoad
from svsa.simulation.plant.loads.sine import SineLoad
from svsa.simulation.reference.kinds import StiffnessReference
from svsa.simulation.reference.kinds.constant import ConstantStiffness
from svsa.simulation.reference.kinds.sine import SineStiffness

DURATION_S = 8.0

Wrong = tuple[tuple[str, float], ...]


class TrainingRun(NamedTuple):
    """The paper's 60° at 0.2 Hz with other stiffness, loads and effects.

    wrong: true over nominal value of fields of the actuator, the nominal model as it is.
    """

    name: str
    title: str
    stiffness: StiffnessReference
    loads: tuple[Load, ...]
    effects: Effects = RIG
    wrong: Wrong = ()
    seed: int = 0

    def build_configuration(self, law: str) -> Configuration:
        """The run under a law."""
        plain = FIGURES["4a"].build_configuration(law, load=False)
        nominal = plain.nominal
        factors = {name: getattr(nominal, name) * ratio for name, ratio in self.wrong}
        return plain.changed(
            stiffness=self.stiffness,
            loads=self.loads,
            effects=self.effects,
            actuator=nominal.changed(**factors),
            seed=self.seed,
        )


def _pulse(torque_nm: tuple[float, float, float], start_s: float, duration_s: float) -> Load:
    return PulseLoad(torque_nm=torque_nm, start_s=start_s, duration_s=duration_s)


_INERTIAS = ("link_inertia_kg_m2", "motor1_inertia_kg_m2", "motor2_inertia_kg_m2")
_NOISY = RIG.changed(noise=SensorNoise())

TRAINING = (
    TrainingRun(
        "pulses",
        "Pulses at σ = 16",
        ConstantStiffness(stiffness_nm_per_rad=16.0),
        (
            _pulse((1.5, 1.5, 1.5), 1.3, 1.6),
            _pulse((-2.0, 0.0, 0.0), 4.1, 0.6),
            _pulse((2.0, -1.0, 0.5), 5.7, 1.1),
        ),
    ),
    TrainingRun(
        "sines",
        "Sines on link and motors, σ a sine, friction",
        SineStiffness(offset_nm_per_rad=35.0, amplitude_nm_per_rad=15.0, frequency_hz=0.3),
        (
            SineLoad(torque_nm=(1.2, 0.0, 0.0), frequency_hz=1.4, start_s=1.0),
            SineLoad(torque_nm=(0.0, 1.0, 0.5), frequency_hz=2.6, start_s=4.0),
        ),
        RIG.changed(friction=Friction()),
    ),
    TrainingRun(
        "mass",
        "2.5 kg, inertias half as much again",
        ConstantStiffness(stiffness_nm_per_rad=28.0),
        (MassLoad(mass_kg=2.5, start_s=2.0),),
        RIG.changed(friction=Friction()),
        tuple((name, 1.5) for name in _INERTIAS),
    ),
    TrainingRun(
        "light",
        "Half the inertias, noise, σ = 70",
        ConstantStiffness(stiffness_nm_per_rad=70.0),
        (PaperLoad(start_s=3.0),),
        _NOISY,
        tuple((name, 0.5) for name in _INERTIAS),
        seed=1,
    ),
    TrainingRun(
        "mixed",
        "A light link on a heavy motor, noise, σ = 22",
        ConstantStiffness(stiffness_nm_per_rad=22.0),
        (
            ConstantLoad(torque_nm=(1.0, 0.0, 0.0), start_s=2.0),
            _pulse((0.0, 2.0, -1.0), 4.3, 1.5),
        ),
        _NOISY,
        ((_INERTIAS[0], 0.8), (_INERTIAS[1], 1.2), ("spring_stiffness_n_per_m", 1.1)),
        seed=2,
    ),
)
"""What `svsa tune` runs a candidate through."""

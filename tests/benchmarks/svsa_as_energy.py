"""`python -m tests.benchmarks.svsa_as_energy`: the SVSA as one more energy, not by hand.

Prints the largest differences of a run, and the CPU time of a tick as a multiple of that with the
hand-written derivatives: median and quartiles of paired repetitions.
"""

import statistics
import time
from dataclasses import replace
from importlib.metadata import EntryPoint
from typing import Literal

import numpy as np

import svsa
from svsa.actuators import installed
from svsa.actuators.mechanisms.svsa import SVSA_MECHANISM
from svsa.actuators.parameters import ActuatorParameters, MechanismParameters
from svsa.actuators.signals import CHANNEL_INDEX
from svsa.inputs.checked import Number, quantity

NAME, REPEATS, SHORT_S, LONG_S = "svsa_energy", 15, 5.0, 45.0
Law = Literal["fl", "ndobc"]
LAWS: tuple[Law, ...] = ("fl", "ndobc")
CHANNELS = ("position_rad", "stiffness_nm_per_rad", "torque1_nm", "torque2_nm")


class EnergyParameters(MechanismParameters):
    """The constants of the SVSA, of which the equations follow from its energy."""

    mechanism: Literal["svsa_energy"] = NAME
    spring_stiffness_n_per_m: Number = quantity("N/m", "Spring stiffness k", gt=0)
    radius_m: Number = quantity("m", "Radius r", gt=0)
    spiral_reduction: Number = quantity("1", "Spiral reduction γ", gt=0)


def convert(parameters: MechanismParameters) -> EnergyParameters:
    assert isinstance(parameters, ActuatorParameters)
    return EnergyParameters(
        **parameters.model_dump(include={*EnergyParameters.model_fields} - {"mechanism"})
    )


AS_ENERGY = replace(
    SVSA_MECHANISM,
    name=NAME,
    parameters=EnergyParameters,
    prototype=convert(SVSA_MECHANISM.prototype),
    nominal=convert(SVSA_MECHANISM.nominal),
    published={},
)


def run(name: str, law: Law, duration_s: float) -> svsa.Result:
    mechanism = installed.get_mechanism(name)
    return svsa.simulate(
        "4a",
        law,
        actuator=mechanism.prototype,
        nominal=mechanism.nominal,
        limits=mechanism.limits,
        stiffness=60.0,
        duration_s=duration_s,
    )


def measure_tick_s(name: str, law: Law) -> float:
    """CPU time of a tick, s: the start of a run cancels out."""
    times = []
    for duration_s in (SHORT_S, LONG_S):
        begin = time.process_time()
        run(name, law, duration_s)
        times.append(time.process_time() - begin)
    return (times[1] - times[0]) / (LONG_S - SHORT_S) * 1e-3


def main() -> None:
    entries = installed._find_entries()  # pyright: ignore[reportPrivateUsage]
    entries[NAME] = EntryPoint(NAME, f"{__spec__.name}:AS_ENERGY", installed.GROUP)
    for law in LAWS:
        by_hand, by_energy = run("svsa", law, 10.0).samples, run(NAME, law, 10.0).samples
        print(f"{law}: {np.count_nonzero(by_hand != by_energy)} of {by_hand.size} values differ")
        for channel in CHANNELS:
            column = CHANNEL_INDEX[channel]
            print(f"  {channel}: at most {abs(by_hand - by_energy)[:, column].max():.1e}")
        ratios = []
        for number in range(REPEATS):
            names = ("svsa", NAME) if number % 2 else (NAME, "svsa")
            ticks = {name: measure_tick_s(name, law) for name in names}
            ratios.append(ticks[NAME] / ticks["svsa"])
        low, median, high = statistics.quantiles(ratios, n=4)
        print(f"  CPU time of a tick: {median:.2f} ({low:.2f} to {high:.2f}) of that by hand")


if __name__ == "__main__":
    main()

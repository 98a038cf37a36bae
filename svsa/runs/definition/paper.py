"""The paper's experiments as data: Figures 4A, 4B and 5 simulated, 6A, 6B and 7 on a bench."""

from typing import NamedTuple

from svsa.errors import ParameterError, Violation
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.design import Design
from svsa.runs.definition.design_file import load_prototype
from svsa.simulation.plant.loads import Load
from svsa.simulation.plant.loads.constant import ConstantLoad
from svsa.simulation.plant.loads.paper import PAPER_TORQUE_NM, PaperLoad
from svsa.simulation.reference.kinds import PositionReference, StiffnessReference
from svsa.simulation.reference.paper import FIGURE_REFERENCES, ON_BENCH

LOAD_TIME_S = 5.0
DURATION_S = 20.0
BEFORE_S = (1.0, 5.0)
PEAK_S = (5.0, 7.0)
STEADY_S = (8.0, 20.0)


class Figure(NamedTuple):
    """A figure: its key, title, references, load, and the paper's claim."""

    key: str
    title: str
    position: PositionReference
    stiffness: StiffnessReference
    claim: str
    hung: Load = PaperLoad(start_s=LOAD_TIME_S)

    def build_configuration(
        self, law: str = "ndobc", load: bool = True, design: Design | None = None
    ) -> Configuration:
        """Build the run of the figure.

        Args:
            law: Name of the control law.
            load: Whether the paper's 3 kg have their onset at 5 s.
            design: Parameters, gains and limits; default: those of the paper.

        Returns:
            The configuration.
        """
        loads = (self.hung,) if load else ()
        return Configuration(
            **dict(design or load_prototype()),
            law=law,
            position=self.position,
            stiffness=self.stiffness,
            loads=loads,
        )


_CLAIM_FIXED = (
    "Both laws track alike for the first 5 s; after the load FL tracks poorly and"
    " NDOBC continues to track; the stiffness has little effect."
)

FIGURES = {
    key: Figure(key, title, *FIGURE_REFERENCES[key], claim)
    for key, title, claim in (
        ("4a", "Figure 4A: low stiffness, 15 N·m/rad", _CLAIM_FIXED),
        ("4b", "Figure 4B: high stiffness, 60 N·m/rad", _CLAIM_FIXED),
        (
            "5",
            "Figure 5: variable stiffness, 35 + sin N·m/rad",
            "Both errors are small without the load; after it both grow with FL, and NDOBC"
            " stays better.",
        ),
    )
}

# 3 kg on a cable over a pulley of 68 mm: a step of torque on the link alone.
CABLE_PULL = ConstantLoad(start_s=LOAD_TIME_S, torque_nm=(PAPER_TORQUE_NM, 0.0, 0.0))

_CLAIM_BENCH = (
    "After the load NDOBC continues to track and FL does not; the load moves the link less where"
    " it is stiff."
)

BENCH_FIGURES = {
    ON_BENCH[key]: FIGURES[key]._replace(
        key=ON_BENCH[key], title=title, claim=claim, hung=CABLE_PULL
    )
    for key, title, claim in (
        ("4a", "Figure 6A: bench, low stiffness, 15 N·m/rad", _CLAIM_BENCH),
        ("4b", "Figure 6B: bench, high stiffness, 60 N·m/rad", _CLAIM_BENCH),
        (
            "5",
            "Figure 7: bench, variable stiffness, 35 + sin N·m/rad",
            "The stiffness shows no change at the load with NDOBC, and an error with FL.",
        ),
    )
}


def get_figure(key: str) -> Figure:
    """Return a figure of the paper.

    Args:
        key: Its number and letter, "4a" to "7".

    Returns:
        The figure with its settings and claims.

    Raises:
        ParameterError: If there is no such figure.
    """
    figures = FIGURES | BENCH_FIGURES
    figure = figures.get(str(key).lower())
    if figure is None:
        raise ParameterError(Violation("figure", key, "", "one of " + ", ".join(figures)))
    return figure


def get_simulated_figure(key: str) -> Figure:
    """Return a simulated figure of the paper.

    Args:
        key: "4a", "4b" or "5".

    Returns:
        The figure with its settings and claims.

    Raises:
        ParameterError: If there is no such figure. For Figures 6A, 6B and 7, which were measured on
            a bench, the message describes how to run them.
    """
    figure = get_figure(key)
    if figure.key not in BENCH_FIGURES:
        return figure
    simulated = next(name for name, bench in ON_BENCH.items() if bench == figure.key)
    bound = (
        f"a simulated figure, {', '.join(FIGURES)}. Figure {figure.key.upper()} is measured on a"
        f' bench: run svsa.reproduce(("{figure.key}",)) for it on the emulated bench, or simulate'
        f' its references with the effects of the rig: svsa.simulate("{simulated}",'
        " effects=svsa.RIG)"
    )
    raise ParameterError(Violation("experiment", key, "", bound))

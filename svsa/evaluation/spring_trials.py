"""`svsa spring-trials`: how often the interval of the spring estimator contains the true spring.

A trial draws another plant than the nominal model, a motion, a stiffness and a load on the link. A
scale error c of the torque is simulated exactly: a motor that delivers c times the commanded torque
moves like a plant whose inertias, dampings, springs and loads are divided by c.
"""

import json
import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

import numpy as np
import typer
from rich.console import Console
from rich.table import Table
from scipy.stats import beta

from svsa.actuators.parameters import SVSA, MechanismParameters
from svsa.control.installed import get_law
from svsa.control.law_names import AnyLaw, KnownLaw
from svsa.control.observers.spring import SpringEstimation
from svsa.inputs.output_file import check_picture
from svsa.runs.definition.design_file import load_prototype
from svsa.runs.definition.experiment import build_experiment
from svsa.runs.result.progress import follow_progress
from svsa.runs.result.result import Result
from svsa.runs.result.simulate import simulate
from svsa.simulation.plant.effects.effect import PresetName
from svsa.simulation.plant.effects.friction import Friction
from svsa.simulation.plant.loads.constant import ConstantLoad
from svsa.simulation.reference.kinds.sine import SinePosition

if TYPE_CHECKING:
    from matplotlib.figure import Figure

LOAD_S, DURATION_S = 5.0, 9.0
AFTER_S = 1.5
"""Time from the load to the first value that is graded after it, s."""
SPRING, INERTIA, DAMPING = 0.3, 0.2, 0.5
"""Half ranges of the errors of the nominal model, relative to the plant."""
TORQUES_NM = 0.5, 2.5
STIFFNESSES_NM_PER_RAD = 12.0, 90.0
STRONG_NM, NARROW = 1.0, 0.02
Z95 = 1.959964
"""Half width of a 95 % interval, in standard deviations."""
_INERTIAS = ("link_inertia_kg_m2", "motor1_inertia_kg_m2", "motor2_inertia_kg_m2")
_DAMPINGS = ("link_damping_nms_per_rad", "motor1_damping_nms_per_rad", "motor2_damping_nms_per_rad")
_SPRING = "spring_stiffness_n_per_m"
EXAMPLE_RATIO, EXAMPLE_LAWS = 0.75, (AnyLaw("ndobc"), AnyLaw("ndobc_k"))


@dataclass(frozen=True)
class Reading:
    """The estimate at one time, relative to the true stiffness.

    Attributes:
        error: σ̂/σ − 1.
        half_width: Half of the 95 % interval, over σ.
    """

    error: float
    half_width: float

    @property
    def covers(self) -> bool:
        """Whether the interval contains the true stiffness."""
        return abs(self.error) <= self.half_width


@dataclass(frozen=True)
class SpringTrial:
    """One trial.

    Attributes:
        number: Number of the trial, which with the seed determines it.
        torque_nm: Torque of the load on the link, N·m.
        stiffness_nm_per_rad: σ_d, N·m/rad.
        spring: K/K_n.
        scale: Delivered over commanded torque.
        before: Just before the load; None if the run or the estimate had ended.
        after: 1.5 s after the load; None as above.
        last: At the end; None as above.
        outcome: "estimated", "refused" (another shape) or the code of the fault that ended the run.
        stiffness_error: Root mean square of σ_d/σ − 1 from 1.5 s after the load on; NaN if the run
            had ended.
        position_error_deg: Root mean square of the position error there, degrees.
        torque1_nm: Root mean square of u1 there, N·m.
    """

    number: int
    torque_nm: float
    stiffness_nm_per_rad: float
    spring: float
    scale: float
    before: Reading | None
    after: Reading | None
    last: Reading | None
    outcome: str
    stiffness_error: float
    position_error_deg: float
    torque1_nm: float


def draw_plant(
    nominal: MechanismParameters, random: np.random.Generator, scale: float
) -> tuple[MechanismParameters, float]:
    """Draw a plant around a nominal model; return it with its K/K_n.

    Args:
        nominal: Parameters of the nominal model.
        random: Source of the numbers.
        scale: Delivered over commanded torque; every parameter is divided by it.
    """
    spring = 1.0 + random.uniform(-SPRING, SPRING)
    factors = {_SPRING: spring}
    factors |= {name: 1.0 + random.uniform(-INERTIA, INERTIA) for name in _INERTIAS}
    factors |= {name: 1.0 + random.uniform(-DAMPING, DAMPING) for name in _DAMPINGS}
    changes = {name: getattr(nominal, name) * factor / scale for name, factor in factors.items()}
    return nominal.changed(**changes), spring


def run_trial(
    seed: int,
    number: int,
    effects: PresetName,
    scale: float,
    law: KnownLaw | AnyLaw = "ndobc",
    estimation: SpringEstimation | None = None,
) -> tuple[SpringTrial, Result]:
    """Simulate one trial.

    Args:
        seed: Seed of all trials.
        number: Number of the trial.
        effects: Preset of the effects.
        scale: Largest relative error of the delivered torque, on both sides.
        law: Law of the run.
        estimation: Settings of the estimator; by default its defaults.

    Returns:
        The trial, and its run.
    """
    random = np.random.default_rng([seed, number])
    c = 1.0 + random.uniform(-scale, scale)
    design = load_prototype()
    plant, spring = draw_plant(design.nominal, random, c)
    sigma = random.uniform(*STIFFNESSES_NM_PER_RAD)
    sign = random.choice([-1.0, 1.0])
    torque = sign * random.uniform(*TORQUES_NM)
    position = SinePosition(
        amplitude_rad=random.uniform(0.0, 1.0), frequency_hz=random.uniform(0.1, 0.5)
    )
    run = simulate(
        law=law,
        position=position,
        stiffness=sigma,
        effects=effects,
        seed=number,
        actuator=plant,
        nominal=design.nominal,
        spring=estimation or SpringEstimation(),
        loads=[ConstantLoad(torque_nm=(torque / c, 0.0, 0.0), start_s=LOAD_S)],
        duration_s=DURATION_S,
    )
    times = LOAD_S - 0.001, LOAD_S + AFTER_S, DURATION_S - 0.001
    before, after, last = (_read(run, time, c) for time in times)
    refused = len(run.time_s) > 0 and math.isnan(run.spring_ratio[-1])
    outcome = run.fault.code if run.fault else "refused" if refused else "estimated"
    rest = slice(round((LOAD_S + AFTER_S) / run.configuration.sampling.period_s), None)
    true = run.stiffness_nm_per_rad[rest] * c
    trial = SpringTrial(
        number=number,
        torque_nm=torque,
        stiffness_nm_per_rad=sigma,
        spring=spring,
        scale=c,
        before=before,
        after=after,
        last=last,
        outcome=str(outcome),
        stiffness_error=_compute_rms(sigma / true - 1.0),
        position_error_deg=math.degrees(_compute_rms(run.position_error_rad[rest])),
        torque1_nm=_compute_rms(run.torque1_nm[rest]),
    )
    return trial, run


def run_bench_trial(seed: int, number: int, scale: float) -> SpringTrial:
    """Run one trial on the emulated bench, whose motor 1 has another friction and torque constant.

    Args:
        seed: Seed of all trials.
        number: Number of the trial.
        scale: Largest relative error of the torque constant, on both sides.

    Returns:
        The trial; the true stiffness is not measured on a bench: that of the nominal spring times
        the true K/K_n stands for it.
    """
    # Imported here: a simulation needs no bench.
    from svsa.hardware.emulator.experiment import run_request
    from svsa.hardware.emulator.parameters import build_emulator_parameters

    random = np.random.default_rng([seed, number])
    c = 1.0 + random.uniform(-scale, scale)
    design = load_prototype()
    plant, spring = draw_plant(design.nominal, random, 1.0)
    sigma = random.uniform(*STIFFNESSES_NM_PER_RAD)
    torque = random.choice([-1.0, 1.0]) * random.uniform(*TORQUES_NM)
    home = build_emulator_parameters(SVSA)
    motor = home.motor1.changed(torque_constant_nm_per_a=c * home.motor1.torque_constant_nm_per_a)
    friction = Friction(coulomb1_nm=random.uniform(0.05, 0.3))
    emulated = home.changed(actuator=plant, motor1=motor, friction=friction)
    request = build_experiment(
        "4a",
        None,
        {
            "position": SinePosition(
                amplitude_rad=random.uniform(0.0, 0.8), frequency_hz=random.uniform(0.1, 0.5)
            ),
            "stiffness": sigma,
            "loads": [],
            "spring": SpringEstimation(scale_deviation=scale / math.sqrt(3.0)),
        },
        run_bench_trial,
    )
    load = ConstantLoad(torque_nm=(torque, 0.0, 0.0))
    run = run_request(request, load, LOAD_S, DURATION_S, lambda share: None, emulated)
    before, after, last = (
        _read_ratio(run, time, spring)
        for time in (LOAD_S - 0.001, LOAD_S + AFTER_S, DURATION_S - 0.001)
    )
    rest = slice(round((LOAD_S + AFTER_S) / 0.001), None)
    return SpringTrial(
        number=number,
        torque_nm=torque,
        stiffness_nm_per_rad=sigma,
        spring=spring,
        scale=c,
        before=before,
        after=after,
        last=last,
        outcome="refused" if math.isnan(run.spring_ratio[-1]) else "estimated",
        stiffness_error=_compute_rms(sigma / (spring * run.stiffness_nm_per_rad[rest]) - 1.0),
        position_error_deg=math.degrees(_compute_rms(run.position_error_rad[rest])),
        torque1_nm=_compute_rms(run.torque1_nm[rest]),
    )


def _read_ratio(run: Result, time_s: float, spring: float) -> Reading | None:
    at = round(time_s / run.configuration.sampling.period_s)
    if math.isnan(run.spring_ratio[at]):
        return None
    half_width = Z95 * run.spring_ratio_deviation[at] / spring
    return Reading(float(run.spring_ratio[at] / spring - 1.0), float(half_width))


def _compute_rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2))) if len(values) else math.nan


def _read(run: Result, time_s: float, scale: float) -> Reading | None:
    at = round(time_s / run.configuration.sampling.period_s)
    if at >= len(run.time_s) or math.isnan(run.spring_ratio[at]):
        return None
    true = run.stiffness_nm_per_rad[at] * scale
    deviation = run.stiffness_deviation_nm_per_rad[at]
    error = run.stiffness_estimate_nm_per_rad[at] / true - 1.0
    return Reading(float(error), float(Z95 * deviation / true))


class Coverage(NamedTuple):
    """Statistics of some readings.

    Attributes:
        readings: Number of them.
        covered: Share whose interval contains the true stiffness.
        low: Lower end of its 95 % interval (Clopper and Pearson).
        high: Upper end.
        median_error: Median of |error|.
        largest_error: Largest |error|.
        median_half_width: Median of the half widths.
        narrow: Share of half widths of at most 2 %.
    """

    readings: int
    covered: float
    low: float
    high: float
    median_error: float
    largest_error: float
    median_half_width: float
    narrow: float


def summarize(readings: Sequence[Reading]) -> Coverage:
    """Summarize readings, at least one."""
    n, covered = len(readings), sum(reading.covers for reading in readings)
    errors = [abs(reading.error) for reading in readings]
    half_widths = np.array([reading.half_width for reading in readings])
    return Coverage(
        readings=n,
        covered=covered / n,
        low=float(beta.ppf(0.025, covered, n - covered + 1)) if covered else 0.0,
        high=float(beta.ppf(0.975, covered + 1, n - covered)) if covered < n else 1.0,
        median_error=float(np.median(errors)),
        largest_error=max(errors),
        median_half_width=float(np.median(half_widths)),
        narrow=float(np.mean(half_widths <= NARROW)),
    )


def draw_example() -> "Figure":
    """Draw stiffness and estimate under NDOBC and NDOBC-K; needs the extra `plot`.

    The spring of the plant is 25 % softer than that of the model.
    """
    from matplotlib.figure import Figure

    from svsa.runs.result.plot import label_axes

    figure = Figure(figsize=(9.0, 3.4), layout="constrained")
    nominal = load_prototype().nominal
    softer = {_SPRING: EXAMPLE_RATIO * getattr(nominal, _SPRING)}
    for axes, law in zip(figure.subplots(1, 2, sharey=True), EXAMPLE_LAWS, strict=True):
        run = simulate(
            law=law,
            position=SinePosition(amplitude_rad=0.5, frequency_hz=0.25),
            stiffness=30.0,
            effects="rig",
            actuator=softer,
            spring=SpringEstimation(),
            loads=[ConstantLoad(torque_nm=(-2.0, 0.0, 0.0), start_s=LOAD_S)],
            duration_s=DURATION_S,
        )
        time, estimate = run.time_s, run.stiffness_estimate_nm_per_rad
        half = Z95 * run.stiffness_deviation_nm_per_rad
        band: dict[str, Any] = {"color": "C0", "alpha": 0.25, "linewidth": 0.0}
        axes.fill_between(time, estimate - half, estimate + half, label="95 % interval", **band)
        axes.plot(time, estimate, color="C0", linewidth=1.2, label="estimate")
        axes.plot(time, run.stiffness_nm_per_rad, color="C1", linewidth=1.2, label="true")
        shown = estimate / run.spring_ratio
        axes.plot(time, shown, color="C2", linewidth=1.0, linestyle="--", label="nominal spring")
        axes.axvline(LOAD_S, color="#888888", linewidth=0.8, linestyle=":")
        axes.set_title(get_law(law).title, fontsize="medium")
        axes.set_ylim(10.0, 45.0)
        axes.set_xlabel("Time [s]")
        label_axes(axes, "Stiffness [N·m/rad]" if law == EXAMPLE_LAWS[0] else "")
        if law == EXAMPLE_LAWS[0]:
            axes.legend(fontsize="small", frameon=False, loc="lower right")
    return figure


def spring_trials(
    trials: Annotated[int, typer.Option(help="Number of trials.", min=1, max=100_000)] = 200,
    effects: Annotated[PresetName, typer.Option(help="Non-ideal effects.")] = "full",
    seed: Annotated[int, typer.Option(help="Seed of the trials.", min=0)] = 1,
    law: Annotated[str, typer.Option(help="Law of the runs.")] = "ndobc",
    scale: Annotated[
        float,
        typer.Option(
            help="Largest relative error of the torque; the estimator gets its deviation.",
            min=0.0,
            max=0.2,
        ),
    ] = 0.0,
    bench: Annotated[
        bool, typer.Option("--bench", help="On the emulated bench; about 20 s a trial.")
    ] = False,
    plot: Annotated[
        Path | None, typer.Option(help="Picture of an example (.png, .pdf, .svg).")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
) -> None:
    """Test the spring estimator on random plants, motions and loads."""
    check_picture("--plot", plot)
    if plot is not None:
        draw_example().savefig(plot, dpi=110)
    known = SpringEstimation()
    if scale:
        # Of a uniform distribution from −scale to scale.
        known = known.changed(scale_deviation=scale / math.sqrt(3.0))
    done: list[SpringTrial] = []
    with follow_progress("Simulating", None) as follow:
        for number in range(trials):
            if bench:
                done.append(run_bench_trial(seed, number, scale))
            else:
                done.append(run_trial(seed, number, effects, scale, AnyLaw(law), known)[0])
            follow(len(done) / trials)
    if as_json:
        typer.echo(json.dumps([asdict(trial) for trial in done]))
        return
    console = Console()
    for table in _build_tables(done):
        console.print(table, highlight=False)
    outcomes = Counter(trial.outcome for trial in done)
    console.print(", ".join(f"{count} {outcome}" for outcome, count in outcomes.items()))


def _build_tables(trials: Sequence[SpringTrial]) -> tuple[Table, Table]:
    strong = [trial for trial in trials if abs(trial.torque_nm) >= STRONG_NM]
    later = f"{AFTER_S:g} s after the load"
    groups = {
        "before the load": [trial.before for trial in trials],
        later: [trial.after for trial in trials],
        f"{later}, if ≥ {STRONG_NM:g} N·m": [trial.after for trial in strong],
        f"at the end, if ≥ {STRONG_NM:g} N·m": [trial.last for trial in strong],
    }
    heads = ("covered [%]", "error, median, largest [%]", "half width, median [%]", "≤ 2 % [%]")
    estimate = Table("time", "trials", *heads, title="Estimated stiffness")
    for name, group in groups.items():
        readings = [reading for reading in group if reading is not None]
        if readings:
            c = summarize(readings)
            estimate.add_row(
                name,
                f"{c.readings}",
                f"{100 * c.covered:.1f} ({100 * c.low:.1f}–{100 * c.high:.1f})",
                f"{100 * c.median_error:.2f}, {100 * c.largest_error:.1f}",
                f"{100 * c.median_half_width:.2f}",
                f"{100 * c.narrow:.0f}",
            )
    control = Table("", "median", "largest", title=f"Control from {later} on, root mean squares")
    measured = {
        "σ_d/σ − 1, true stiffness [%]": [100 * trial.stiffness_error for trial in trials],
        "position error [°]": [trial.position_error_deg for trial in trials],
        "u1 [N·m]": [trial.torque1_nm for trial in trials],
    }
    for name, values in measured.items():
        kept = [value for value in values if math.isfinite(value)]
        if kept:
            control.add_row(name, f"{np.median(kept):.3g}", f"{max(kept):.3g}")
    return estimate, control

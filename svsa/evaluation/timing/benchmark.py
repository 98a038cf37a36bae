"""`svsa benchmark`: cost of the loop compared with a C loop of the same work.

Times are CPU times, the minimum of many, of both loops alternately. Their ratio hardly depends on
other load or on the speed of the machine.
"""

import ctypes
import os
import resource
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from svsa.actuators.installed import list_mechanism_names
from svsa.actuators.lever import compute_lever_ratio_slope
from svsa.actuators.parameters import SVSA
from svsa.actuators.signals import CHANNELS
from svsa.control.installed import BASELINE, PAPERS_LAW
from svsa.control.laws.feedback_linearization import build_gains
from svsa.evaluation.timing.batch_rates import measure_effects, measure_two_cores
from svsa.evaluation.timing.bench_tick import measure_bench_tick
from svsa.evaluation.timing.c_compiler import FLAGS, find_c_compiler
from svsa.evaluation.timing.scipy_comparison import compare_with_scipy
from svsa.evaluation.timing.turns import measure_in_turns
from svsa.runs.definition.arm_experiment import build_arm_experiment
from svsa.runs.definition.experiment import build_actuator_experiment
from svsa.runs.definition.paper import DURATION_S, LOAD_TIME_S, get_figure
from svsa.runs.execution.arm_run import ArmRun
from svsa.runs.execution.batch import build_run_batch
from svsa.runs.execution.run import Run
from svsa.runs.result.simulate import simulate
from svsa.simulation.arm.loop import advance_arm
from svsa.simulation.loop.batch import run_batch
from svsa.simulation.loop.loop import advance
from svsa.simulation.plant.loads.paper import PAPER_TORQUE_NM

C_LOOP = Path(__file__).parents[3] / "tests" / "benchmarks" / "loop.c"
LANES = 32
REPEATS = 15
FIGURE, LAW = "4a", "ndobc"
COMPILE = (f"from svsa.cli import prepare; prepare({(PAPERS_LAW, BASELINE)!r})",)
"""Functions that `make run` compiles at its first start."""
FIRST_RUN = (f"import svsa; svsa.simulate({FIGURE!r}, {LAW!r})",)


class CLoop(NamedTuple):
    """The compiled C loop: one run with all its samples, and 32 lanes side by side.

    channels: Names of its columns; they do not depend on those of a record.
    """

    channels: tuple[str, ...]
    run_one: Callable[..., int]
    run_lanes: Callable[..., int]


def build_c_loop(folder: Path) -> CLoop | None:
    """Compile the C loop into `folder`; None without its source or without a C compiler.

    The source is a file of the tests: an installed package does not contain it.
    """
    compiler = find_c_compiler()
    if compiler is None or not C_LOOP.exists():
        return None
    library = folder / "loop.so"
    subprocess.run(  # noqa: S603  the machine's own compiler on a file of this project
        [compiler, *FLAGS, "-shared", "-fPIC", "-o", str(library), str(C_LOOP), "-lm"], check=True
    )
    loaded = ctypes.CDLL(str(library))
    loaded.run_one.restype = loaded.run_lanes.restype = ctypes.c_long
    names = ctypes.string_at(ctypes.addressof(ctypes.c_char.in_dll(loaded, "channels"))).decode()
    return CLoop(tuple(names.split()), loaded.run_one, loaded.run_lanes)


def list_c_constants(run: Run) -> np.ndarray:
    """List the constants of a run of Figure 4A in the order of the C structure, shape (40,)."""
    blocks, configuration = run.blocks[0], run.configuration
    position: Any = configuration.position
    stiffness: Any = configuration.stiffness
    numbers: list[float] = []
    for actuator in (blocks.plant, blocks.nominal):
        a = actuator
        slope = compute_lever_ratio_slope(a.gamma)
        numbers += [a.M, a.B1, a.B2, a.D, a.D1, a.D2, a.K, slope, a.mu0]
    domain = blocks.domain
    numbers += [
        *build_gains(configuration.gains),
        *blocks.shares,
        blocks.torque1_max,
        blocks.torque2_max,
    ]
    numbers += [domain.mu_min, domain.mu_max, domain.deflection_max]
    numbers += [domain.deflection_fraction, domain.singularity_fraction, blocks.period]
    numbers += [position.amplitude_rad, 2.0 * np.pi * position.frequency_hz]
    numbers += [stiffness.stiffness_nm_per_rad, PAPER_TORQUE_NM]
    return np.array([*numbers, round(LOAD_TIME_S / blocks.period)], dtype=float)


def run_c(loop: CLoop, run: Run, samples: np.ndarray) -> int:
    """Run the C loop once into `samples`, shape (ticks, channels); return the ticks done."""
    constants = list_c_constants(run)
    return loop.run_one(_point(constants), ctypes.c_long(len(samples)), _point(samples))


def run_c_lanes(loop: CLoop, run: Run, ticks: int) -> tuple[np.ndarray, np.ndarray]:
    """Run 32 lanes; return Σ and maximum of the squared and absolute position errors."""
    constants = np.repeat(list_c_constants(run)[:, None], LANES, axis=1)
    squares, peaks = np.empty(LANES), np.empty(LANES)
    loop.run_lanes(_point(constants), ctypes.c_long(ticks), _point(squares), _point(peaks))
    return squares, peaks


def build_arm_work(ticks: int) -> Callable[[], object]:
    """Build the work of the kernel of an arm with the same law: `ticks` ticks."""
    run = ArmRun(build_arm_experiment("rods", {}, {"law": LAW}))
    samples = np.empty((2, ticks, len(CHANNELS)))
    inputs = run.arms[0], tuple(run.laws), run.arm_inputs, run.states[0]
    return lambda: advance_arm(*inputs, 0, tuple(samples))


def build_actuator_works() -> dict[str, Callable[[], object]]:
    """Build the work of the kernel of every other installed actuator with the same law."""
    names = (name for name in list_mechanism_names() if name != SVSA)
    return {name: build_kernel_work(Run(build_actuator_experiment(name, LAW))) for name in names}


def build_kernel_work(run: Run) -> Callable[[], object]:
    """Build the work of the loop: the first lane of a run over the duration of a figure."""
    lane = run.blocks[0], run.laws[0], run.inputs, run.lanes[0]
    samples = np.empty((round(DURATION_S / run.period_s), len(CHANNELS)))
    return lambda: advance(*lane, 0, samples)


def measure(repeats: int = REPEATS) -> dict[str, Any]:
    """Measure the figures of `svsa benchmark` except compilation and start.

    Figures that need the C loop are None without it (see `build_c_loop`).
    """
    run = Run(get_figure(FIGURE).build_configuration(LAW))
    ticks = round(DURATION_S / run.period_s)
    actuators = build_actuator_works()
    batch = build_run_batch([run.configuration] * LANES)
    works: dict[str, Callable[[], object]] = {
        "single": lambda: simulate(FIGURE, LAW),
        "kernel": build_kernel_work(run),
        "batch": lambda: run_batch(batch, ticks),
        "arm": build_arm_work(ticks),
        **actuators,
    }
    with tempfile.TemporaryDirectory(prefix="svsa-bench-") as folder:
        loop = build_c_loop(Path(folder))
        if loop is not None:
            samples = np.empty((ticks, len(loop.channels)))
            works["c"] = lambda: run_c(loop, run, samples)
            works["c_lanes"] = lambda: run_c_lanes(loop, run, ticks)
        cost = measure_in_turns(works, repeats)
    effects = measure_effects(run.configuration, LANES, DURATION_S, repeats)
    c, c_lane = cost.get("c"), cost.get("c_lanes", 0.0) / LANES
    return {
        "figure": FIGURE,
        "law": LAW,
        "run_s": DURATION_S,
        "single_run_cpu_s": cost["single"],
        "single_run_realtime_factor": DURATION_S / cost["single"],
        "ratio_to_c": cost["single"] / c if c else None,
        "kernel_ratio_to_c": cost["kernel"] / c if c else None,
        "arm_ratio_to_kernel": cost["arm"] / cost["kernel"],
        "actuator_ratio_to_kernel": {name: cost[name] / cost["kernel"] for name in actuators},
        "batch_runs_per_second_1_core": LANES / cost["batch"],
        "batch_ratio_to_c": c_lane * LANES / cost["batch"] if c else None,
        "runs_per_second_1_core_by_effects": effects,
        "two_cores_over_one": measure_two_cores(batch, ticks, repeats),
        "load_average": os.getloadavg()[0],
        "bench_tick_cpu_us": 1e6 * measure_bench_tick(run, repeats),
        "solvers": {name: each._asdict() for name, each in compare_with_scipy(repeats).items()},
    }


def measure_start() -> dict[str, float]:
    """Measure CPU seconds of `svsa compile` without a cache, then of a first run in Python."""
    costs = []
    with tempfile.TemporaryDirectory(prefix="svsa-bench-") as folder:
        for program in (COMPILE, FIRST_RUN):
            begin = resource.getrusage(resource.RUSAGE_CHILDREN)
            subprocess.run(  # noqa: S603  this program itself
                [sys.executable, "-c", *program],
                env=os.environ | {"SVSA_CACHE": folder},
                check=True,
                capture_output=True,
            )
            end = resource.getrusage(resource.RUSAGE_CHILDREN)
            costs.append(end.ru_utime + end.ru_stime - begin.ru_utime - begin.ru_stime)
    return {"compile_cpu_s": costs[0], "warm_start_cpu_s": costs[1]}


def _point(array: np.ndarray) -> ctypes.c_void_p:
    return ctypes.c_void_p(array.ctypes.data)

"""Compile what the tests use, before they begin: `python -m tests.compile_all [option]`.

Compilation during a test takes seconds, which could delay the test or a rig in parallel. The
summary of the tests lists functions that are still compiled during a test, but not those that are
compiled in a server. --quick: without what `make quick` leaves out: benches, batches and the
identification. --exhaustive: also compiles for `make test-all`: the batches of each law, and the
loop for a processor without any extension.
"""

import os
import subprocess
import sys
from collections.abc import Iterable

import numpy as np

import svsa
from svsa.analysis.design.prediction import predict
from svsa.analysis.identification.identify import identify
from svsa.cli import prepare
from svsa.control.installed import PAPERS_LAW, list_law_names
from svsa.evaluation.ranking.test_set import build_test_trial
from svsa.evaluation.timing.scipy_comparison import compare_with_scipy
from svsa.evaluation.tuning.judge import find_noise_limit
from svsa.hardware.emulator.experiment import LockstepBench
from svsa.runs.definition.paper import FIGURES
from svsa.runs.execution.batch import find_alike, run_configurations, run_group
from svsa.simulation.plant.loads.constant import ConstantLoad
from svsa_server.commands.compiling import OTHER
from tests.analysis.identification.excited_run import build_configuration, build_run, play
from tests.hardware.emulator.in_process_emulator import start_in_process
from tests.runs.paper.golden import GENERIC
from tests.runs.session.sessions import EVERY_EFFECT, SHOWN_IN_BATCHES

TICKS, STIFFNESS, GROUP = 10, 15.0, 8
BATCHES, QUICK, EXHAUSTIVE = "batches", "--quick", "--exhaustive"


def main() -> None:
    """Compile on two cores: the loop and its callers here, independent functions in other
    processes.
    """
    processes = [] if QUICK in sys.argv else [start("tests.compile_all", BATCHES, *sys.argv[1:])]
    if EXHAUSTIVE in sys.argv:
        processes.append(start("tests.runs.paper.golden", "--figures", **GENERIC))
    prepare()
    prepare([PAPERS_LAW], OTHER)
    svsa.Stepper().step((0.0, 0.0))
    svsa.simulate_arm(duration_s=0.01)
    predict(FIGURES["4a"].build_configuration("ndobc"), STIFFNESS)
    compare_with_scipy(repeats=1, duration_s=0.02)
    if QUICK not in sys.argv:
        compile_bench()
        compile_identification()
    for process in processes:
        assert process.wait() == 0, process.args


def start(module: str, *arguments: str, **variables: str) -> subprocess.Popen[bytes]:
    return subprocess.Popen(
        [sys.executable, "-m", module, *arguments],
        env=os.environ | variables,
        stdout=subprocess.DEVNULL,
    )


def compile_bench() -> None:
    """Compile the tick of a bench, which calls any control law, and the emulator."""
    with start_in_process() as emulator:
        bench = LockstepBench(emulator, FIGURES["4a"].build_configuration("ndobc"), TICKS)
        bench.prepare()
        bench.start()
        emulator.control.load(ConstantLoad(torque_nm=(1.0, 0.0, 0.0)))
        bench.tick(TICKS)
        bench.loop.tick(bench.now(), TICKS)
        bench.close()


def compile_identification() -> None:
    """Compile the loop with all non-ideal effects of the rig."""
    move = svsa.SinePosition(amplitude_rad=0.5, frequency_hz=1.0)
    configuration = build_configuration(position=move)
    identify(build_run(configuration, play(configuration, [], 6.5)[0]))


def compile_batches(laws: Iterable[str]) -> None:
    """Compile batches with all effects and with none, for laws with the effects of the rig, and the
    noise limit of tunings.
    """
    for law, effects in (
        ("ndobc", EVERY_EFFECT),
        *((law, svsa.IDEAL) for law in SHOWN_IN_BATCHES),
        *((law, svsa.RIG) for law in laws),
    ):
        configuration = FIGURES["4a"].build_configuration(law).changed(effects=effects, seed=7)
        run_configurations([configuration], TICKS * configuration.sampling.period_s)
    find_noise_limit()


def compile_trials() -> None:
    """Compile the trials of a graded control law, for each delay."""
    trials = [build_test_trial("A", 0, number) for number in range(GROUP)]
    configurations = [one.build_configuration("ndobc") for one in trials]
    for numbers in find_alike(configurations):
        group = [configurations[number] for number in numbers]
        run_group(group, lambda *given: np.zeros((GROUP, 2)), 0.01)


if __name__ == "__main__":
    if BATCHES in sys.argv:
        compile_batches(list_law_names() if EXHAUSTIVE in sys.argv else SHOWN_IN_BATCHES)
        compile_trials()
    else:
        main()

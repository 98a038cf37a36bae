"""Compile what the tests use, before they begin: `python -m tests.compile_all`.

A compiler inside a test takes seconds that the test, or a rig beside it, may not have. What is
still compiled inside a test is told at the end of the tests.
"""

import os
import subprocess
import sys

import svsa
from svsa.cli import prepare
from svsa.identification.identify import identify
from svsa.paper import FIGURES
from svsa.plant.disturbances import ConstantLoad
from svsa.result.bench_run import LockstepBench
from svsa.run.batch import run_configurations
from tests.identification.excited_run import build_configuration, build_run, play
from tests.paper.golden import GENERIC
from tests.rig.in_process_rig import start_in_process
from tests.session.sessions import EVERY_EFFECT

TICKS = 10


BATCHES = "batches"


def main() -> None:
    """On two cores: the loop and what goes through it here, what shares nothing with it beside."""
    beside = [
        start("tests.compile_all", BATCHES),
        start("tests.paper.golden", "--figures", **GENERIC),
    ]
    prepare()
    compile_bench()
    compile_identification()
    for process in beside:
        assert process.wait() == 0, process.args


def start(module: str, *arguments: str, **variables: str) -> subprocess.Popen[bytes]:
    return subprocess.Popen(
        [sys.executable, "-m", module, *arguments],
        env=os.environ | variables,
        stdout=subprocess.DEVNULL,
    )


def compile_bench() -> None:
    """The bench's tick, which calls any law, and the emulated rig."""
    with start_in_process() as rig:
        bench = LockstepBench(rig, FIGURES["4a"].build_configuration("ndobc"), TICKS)
        bench.prepare()
        bench.start()
        rig.control.load(ConstantLoad(torque_nm=(1.0, 0.0, 0.0)))
        bench.tick(TICKS)
        bench.loop.tick(bench.now(), TICKS)
        bench.close()


def compile_identification() -> None:
    """With every effect of a rig, which the loop has not had until here."""
    move = svsa.SinePosition(amplitude_rad=0.5, frequency_hz=1.0)
    configuration = build_configuration(position=move)
    identify(build_run(configuration, play(configuration, [], 6.5)[0]))


def compile_batches() -> None:
    """Runs of a law side by side with every effect, with a rig's, and without any."""
    for law, effects in (
        ("ndobc", EVERY_EFFECT),
        ("ndobc", svsa.IDEAL),
        ("fl_integral", svsa.IDEAL),
        ("ilc", svsa.IDEAL),
        ("lqi", svsa.RIG),
        ("ndobc_w", svsa.RIG),
    ):
        configuration = FIGURES["4a"].build_configuration(law).changed(effects=effects, seed=7)
        run_configurations([configuration], TICKS * configuration.sampling.period_s)


if __name__ == "__main__":
    compile_batches() if sys.argv[1:] == [BATCHES] else main()

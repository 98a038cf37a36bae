"""Compile what the tests use, before they begin: `python -m tests.compile_all`.

A compiler inside a test takes seconds that the test, or a rig beside it, may not have. What is
still compiled inside a test is told at the end of the tests.
"""

import svsa
from svsa.cli import prepare
from svsa.control.installed import list_law_names
from svsa.identification.identify import identify
from svsa.paper import FIGURES
from svsa.plant.disturbances import ConstantLoad
from svsa.result.bench_run import LockstepBench
from svsa.run.batch import run_configurations
from tests.identification.excited_run import build_configuration, build_run, play
from tests.rig.in_process_rig import start_in_process
from tests.session.sessions import EVERY_EFFECT

TICKS = 10


def main() -> None:
    prepare()
    compile_bench()
    compile_identification()
    compile_batches()


def compile_bench() -> None:
    """The bench's tick under every law, and the emulated rig."""
    for law in list_law_names():
        with start_in_process() as rig:
            bench = LockstepBench(rig, FIGURES["4a"].build_configuration(law), TICKS)
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
    identify(build_run(configuration, play(configuration, [], 8.0)[0]))


def compile_batches() -> None:
    """Lanes of a law with every effect, and without any."""
    for law, effects in (
        ("ndobc", EVERY_EFFECT),
        ("ndobc", svsa.IDEAL),
        ("fl_integral", svsa.IDEAL),
        ("ilc", svsa.IDEAL),
    ):
        configuration = FIGURES["4a"].build_configuration(law).changed(effects=effects, seed=7)
        run_configurations([configuration], TICKS * configuration.sampling.period_s)


if __name__ == "__main__":
    main()

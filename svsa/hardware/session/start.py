"""What a run of a bench begins from, as its record keeps it."""

from svsa.hardware.drives.conversion import build_motor_scale
from svsa.hardware.file import BenchFile
from svsa.hardware.realtime.configuration import read_actuation
from svsa.runs.records.bench_start import BenchStart


def describe_start(
    bench: BenchFile, mu0: float, motion: dict[str, list[float]], commands: int
) -> BenchStart:
    """`BenchStart` of a run of this bench; mu0, motion, commands: as its fields."""
    actuation = read_actuation(bench)
    motors = bench.motor1, bench.motor2
    step1, step2 = (abs(build_motor_scale(motor).torque_per_ma) for motor in motors)
    return BenchStart(mu0, *actuation, (step1, step2), motion, commands)

"""A bench as described by its file: bus, drives, motors, encoders, timing and safety.

Properties of a particular motor or encoder have no silent default: a bench without values for
winding, gearbox, efficiency, sign or counts can be checked, but cannot be armed.
"""

from pathlib import Path
from typing import Annotated

from pydantic import BeforeValidator, SerializeAsAny

from svsa.actuators.parameters import SVSA
from svsa.errors import ParameterError, Violation
from svsa.hardware.bench.settings import AXIS_WORDS, BusSettings, DeflectionSettings, MotorSettings
from svsa.hardware.drives.installed import get_family, read_motor
from svsa.inputs.checked import Checked, Flag, Number, Whole, quantity
from svsa.inputs.toml_file import read_toml

PERIODS_S = (0.001, 0.002)


class HomeSettings(Checked):
    """Values at the zero marks."""

    lever_ratio: Number = quantity(
        "1", "Stiffness coordinate s where θ2 = 0; of the SVSA the lever ratio μ", ge=-1e3, le=1e3
    )


class TimingSettings(Checked):
    """Period of the loop, and delays between measurement and action."""

    period_s: Number = quantity("s", "Control period T, 0.001 or 0.002", default=0.001)
    latency_s: Number = quantity(
        "s", "Delay from a tick to its current", ge=0, le=0.002, default=0.0004
    )
    current_lag_s: Number = quantity(
        "s", "Time constant of the current loops", ge=0, le=0.05, default=0.0005
    )
    feedback_age_s: Number = quantity(
        "s", "Age of a count at the time stamp of its frame", ge=0, le=0.005, default=0.0002
    )
    start_silence_s: Number = quantity(
        "s",
        "Time without progress after which a starting loop is abandoned",
        ge=1,
        le=3600,
        default=60.0,
    )


class SafetySettings(Checked):
    """Limits in addition to those of the motors; see `svsa.hardware.safety.guard`."""

    torque_rate_nm_per_s: Number = quantity("N·m/s", "Maximum rate of the torque", gt=0, le=1e6)
    disturbance_max_nm: Number = quantity(
        "N·m", "|ŵ| above which an encoder or motor is considered faulty", gt=0, le=1000
    )
    standstill_max_nm: Number = quantity(
        "N·m",
        "Change of ŵ at constant counts that is a fault: more than twice the friction",
        gt=0,
        default=1.0,
    )
    link_position_max_rad: Number = quantity("rad", "Maximum |q|", gt=0, le=100)
    link_speed_max_rad_per_s: Number = quantity("rad/s", "Maximum speed of the link", gt=0, le=1000)
    ramp_s: Number = quantity(
        "s", "Duration of the ramp from full torque to zero at a stop", ge=0.01, le=5, default=0.3
    )
    stale_zero_s: Number = quantity(
        "s", "Age of the feedback above which the torque is zero", gt=0, le=1, default=0.005
    )
    stale_fault_s: Number = quantity(
        "s", "Age of the feedback above which the run ends in a fault", gt=0, le=1, default=0.020
    )
    missed_ticks: Whole = quantity(
        "ticks", "Consecutive missed ticks that are a fault", ge=1, le=1000, default=20
    )
    loop_s: Number = quantity(
        "s",
        "Silence of the loop after which the supervisor stops the drives",
        ge=0.005,
        le=1,
        default=0.020,
    )
    supervisor_s: Number = quantity(
        "s", "Silence of the supervisor that is a fault", gt=0, le=5, default=0.05
    )
    server_s: Number = quantity(
        "s",
        "Silence of the server after which the torque ramps to zero",
        ge=0.1,
        le=60,
        default=1.0,
    )
    dead_man: Flag = quantity(
        "", "Whether the bench runs only while the operator holds a switch", default=False
    )
    operator_s: Number = quantity(
        "s",
        "Time after the release of the switch when the torque ramps to zero",
        ge=0.05,
        le=2,
        default=0.1,
    )
    needs_watcher: Flag = quantity(
        "", "Whether the bench runs only while a stream of the session is open", default=True
    )


class DesignSettings(Checked):
    """The control design of this bench."""

    actuator: str | None = quantity(
        "", "Installed actuator; default: the actuator of the file, or the SVSA", default=None
    )
    file: str | None = quantity(
        "", "Parameter file; by default the actuator's prototype", default=None
    )
    corner_rad_per_s: Number = quantity(
        "rad/s", "Bandwidth of the state estimator", ge=1, le=2000, default=200.0
    )


class EmulatorSettings(Checked):
    """Control interface and time base of an emulator."""

    control_port: Whole = quantity("", "Control port", ge=1, le=65535)
    lockstep: Flag = quantity(
        "",
        "The emulator (`svsa emulator --lockstep`) waits for the loop: a busy machine slows both,"
        " not late",
        default=False,
    )


Motor = Annotated[SerializeAsAny[MotorSettings], BeforeValidator(read_motor)]
"""A motor's section, validated by its family of drives."""


class BenchFile(Checked):
    """A bench; `path` is where the file lies."""

    name: str = quantity("", "Name")
    bus: BusSettings
    supervisor_bus: BusSettings | None = quantity(
        "", "The supervisor's own adapter, if an adapter serves one program only", default=None
    )
    motor1: Motor
    motor2: Motor
    deflection: DeflectionSettings
    home: HomeSettings
    timing: TimingSettings = TimingSettings()
    safety: SafetySettings
    design: DesignSettings = DesignSettings()
    emulator: EmulatorSettings | None = None
    path: str = quantity("", "The file itself", default="")

    def find_missing(self) -> list[str]:
        """List missing values without which the bench cannot be armed."""
        needed = {
            "motor1": ("counts_per_rev", "gear_ratio", "torque_constant_nm_per_a", "efficiency"),
            "motor2": ("counts_per_rev", "gear_ratio", "torque_constant_nm_per_a", "efficiency"),
            "deflection": ("counts_per_rev",),
        }
        return [
            f"{AXIS_WORDS[section]} has no {_WORDS[name]}: {section}.{name} is not given"
            for section, names in needed.items()
            for name in (*names, "sign")
            if getattr(getattr(self, section), name) is None
        ]


_WORDS = {
    "counts_per_rev": "counts a turn",
    "gear_ratio": "gear ratio",
    "torque_constant_nm_per_a": "torque constant",
    "efficiency": "efficiency",
    "sign": "sign",
}


def read_bench(path: Path | str) -> BenchFile:
    """Read a bench file (TOML).

    Raises:
        ParameterError: If a value is invalid.
    """
    bench = BenchFile(**{**read_toml(path, "bench file"), "path": str(path)})
    for name in ("motor1", "motor2"):
        motor: MotorSettings = getattr(bench, name)
        lowest, highest, peak = motor.position_min_rad, motor.position_max_rad, motor.peak_current_a
        if not lowest < highest:
            bound = f"less than position_max_rad = {highest:g} rad"
            raise ParameterError(Violation(f"{name}.position_min_rad", lowest, "rad", bound))
        if peak < motor.nominal_current_a:
            bound = f"at least nominal_current_a = {motor.nominal_current_a:g} A"
            raise ParameterError(Violation(f"{name}.peak_current_a", peak, "A", bound))
    if bench.timing.period_s not in PERIODS_S:
        bound = "0.001 or 0.002 s: a drive accepts at most one command per ms"
        raise ParameterError(Violation("timing.period_s", bench.timing.period_s, "s", bound))
    motor1, motor2 = bench.motor1, bench.motor2
    if (motor1.drive, motor1.place) == (motor2.drive, motor2.place):
        field = motor2.address_field
        violation = Violation(
            f"motor2.{field}", getattr(motor2, field), "", "different from motor1's"
        )
        raise ParameterError(violation)
    for name, motor in (("motor1", motor1), ("motor2", motor2)):
        for section in ("bus", "supervisor_bus"):
            bus: BusSettings | None = getattr(bench, section)
            if get_family(motor.drive).needs_fd and bus is not None and not bus.fd:
                bound = f"true: the drive of {AXIS_WORDS[name]} ({motor.drive}) needs CAN FD"
                raise ParameterError(Violation(f"{section}.fd", False, "", bound))
    if bench.design.file is None and bench.design.actuator in (None, SVSA):
        check_home(bench)
    return bench


def check_home(bench: BenchFile, low: float = 0.0, high: float = 1.0) -> None:
    """Raise `ParameterError` unless s at the zero mark is between its ends.

    low, high: ends of s; by default those of the lever ratio of the SVSA.
    """
    if not low < bench.home.lever_ratio < high:
        bound = f"greater than {low:.4g} and less than {high:.4g}"
        raise ParameterError(Violation("home.lever_ratio", bench.home.lever_ratio, "", bound))

"""Execution of every command of a bench once before the first tick, to load its code.

The first use of a law, of a kind of reference or of an effect imports modules, loads machine code
from the cache, and compiles missing code. That takes up to 100 ms, but a tick lasts 1 ms.
"""

from collections.abc import Callable
from typing import Any

from svsa.control.gains import Gains
from svsa.control.installed import get_law, list_law_names
from svsa.errors import SvsaError
from svsa.hardware.realtime.loop import BenchLoop
from svsa.hardware.realtime.prepared_laws import PreparedLaws
from svsa.runs.definition.command import read_command
from svsa.runs.definition.configuration import Configuration
from svsa.simulation.plant.effects import EVERY

_CHIRP = {"kind": "chirp", "start_hz": 0.1, "end_hz": 1.0, "duration_s": 1.0}
_TIMES_S = [0.0, 1.0, 2.0]
_LEVELS_RAD = [0.0, 0.1, 0.2]
_TORQUE_NM = [0.1, 0.0, 0.0]


def warm_up(loop: BenchLoop, laws: PreparedLaws, report: Callable[[str], None]) -> None:
    """Use every law and every kind of command once, and restore the loop.

    After that `laws` looks up prepared laws and computes nothing. A law that fails is rejected with
    its reason; the others are not affected.

    Args:
        loop: The loop at rest; its laws are bound by `laws`.
        laws: Laws of the loop.
        report: Called with each step.
    """
    configuration = loop.run.configuration
    names = list_law_names()
    for number, name in enumerate(names, 1):
        report(f"loading the control laws: {name}, {number} of {len(names)}")
        try:
            _use(loop, "law", name)
        except SvsaError as error:
            laws.refused[name] = str(error)
    report("loading the references, loads and effects")
    loop.load(configuration)
    ready = [name for name in names if name not in laws.refused]
    for kind, argument in list_changes(configuration, ready):
        _use(loop, kind, argument)
    # From here on an unprepared law is rejected: loading one in a tick would take 10 to 100 ms.
    laws.close()
    loop.load(configuration)


def _use(loop: BenchLoop, kind: str, argument: Any) -> None:
    """Send the loop a command as its link does, and compute a tick."""
    loop.change(read_command({"tick": 0, "kind": kind, "argument": argument}))
    loop.warm_up()


def list_changes(configuration: Configuration, laws: list[str]) -> list[tuple[str, Any]]:
    """List a change of every kind, with every kind of reference and load.

    Args:
        configuration: Configuration of the bench.
        laws: Usable laws.

    Returns:
        Kind and argument of each, as JSON values. The bench accepts all of them.
    """
    c, limits = configuration.model_dump(mode="json"), configuration.limits
    middle = 0.5 * (limits.stiffness_min_nm_per_rad + limits.stiffness_max_nm_per_rad)
    own = [law for law in laws if get_law(law).parameters is not Gains]
    lane = {"law": configuration.law}
    positions = (
        {"kind": "constant"},
        {"kind": "sine", "amplitude_rad": 0.1, "frequency_hz": 1.0},
        {"kind": "steps", "time_s": _TIMES_S, "position_rad": _LEVELS_RAD},
        {"kind": "minimum_jerk", "end_rad": 0.1, "duration_s": 1.0},
        {**_CHIRP, "amplitude_rad": 0.1},
        {"kind": "series", "time_s": _TIMES_S, "position_rad": _LEVELS_RAD},
    )
    steady, held = {"offset_nm_per_rad": middle, "amplitude_nm_per_rad": 0.0}, [middle] * 3
    stiffnesses = (
        {"kind": "constant", "stiffness_nm_per_rad": middle},
        {"kind": "sine", **steady, "frequency_hz": 1.0},
        {"kind": "steps", "time_s": _TIMES_S, "stiffness_nm_per_rad": held},
        {
            "kind": "minimum_jerk",
            "start_nm_per_rad": middle,
            "end_nm_per_rad": middle,
            "duration_s": 1.0,
        },
        {**_CHIRP, **steady},
        {"kind": "series", "time_s": _TIMES_S, "stiffness_nm_per_rad": held},
    )
    loads = (
        {"kind": "paper"},
        {"kind": "mass"},
        {"kind": "constant", "torque_nm": _TORQUE_NM},
        {"kind": "pulse", "torque_nm": _TORQUE_NM, "duration_s": 0.1},
        {"kind": "push", "torque_nm": _TORQUE_NM},
        {"kind": "sine", "torque_nm": _TORQUE_NM, "frequency_hz": 1.0},
        {"kind": "series", "time_s": _TIMES_S, "torque_nm": [_TORQUE_NM] * 3},
    )
    return [
        *(("position", reference) for reference in positions),
        *(("stiffness", reference) for reference in stiffnesses),
        ("law", configuration.law),
        ("laws", [configuration.law]),
        ("gains", c["gains"]),
        ("parameters", {law: {} for law in own}),
        ("observer", c["observer"]),
        ("spring", c["spring"]),
        ("actuator", c["actuator"]),
        ("nominal", c["nominal"]),
        ("effects", EVERY.model_dump(mode="json")),
        ("comparisons", [lane, lane]),
        ("lane", {"lane": 2, "setting": lane}),
        *(("load", load) for load in loads),
        ("unload", 1),
        ("stop", None),
    ]

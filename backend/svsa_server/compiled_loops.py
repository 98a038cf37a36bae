"""Compiled loops of other actuators: whether there is one, and a process that compiles it."""

import asyncio
import re
import subprocess
import time
from collections.abc import Sequence

from svsa.actuators.elasticity import Actuator, ElasticActuator
from svsa.actuators.installed import list_mechanism_names
from svsa.actuators.parameters import SVSA
from svsa.control.installed import get_law
from svsa.numerics.compilation import is_compiled_before
from svsa.numerics.separate_compilation import build_child, can_store
from svsa.simulation.arm.loop import advance_arm
from svsa.simulation.loop.loop import advance

LOWEST_PRIORITY = 19
COMPILE = f"import os; os.nice({LOWEST_PRIORITY}); from svsa.cli import main; main()"
_OTHER_LOOP, _OTHER_LAW = ElasticActuator.__name__, "torques_address"
"""Names in the types of the loop and of a law for another actuator than the SVSA."""
_PLANT = re.compile(r"\bBlocks\((\w+)")
"""The plant of each joint in the types of the loop of an arm; one for joints of one type."""
_compiling = asyncio.Lock()
_begun: list[float] = []
"""Time at which the current compilation began; empty if there is none."""


def find_compiling_s() -> float | None:
    """Return how long a first session has waited for the compiler, s; None if none waits."""
    return time.monotonic() - _begun[0] if _begun else None


def is_compiled_for(actuator: str, law: str) -> bool:
    """Whether the cache has the loop and a law for an actuator."""
    control = get_law(law).control
    if actuator == SVSA or not hasattr(control, "py_func"):
        return True
    return is_compiled_before(advance, _OTHER_LOOP) and is_compiled_before(control, _OTHER_LAW)


async def compile_for(actuator: str, law: str) -> None:
    """Compile the loop and a law for an actuator in a process of its own.

    The compiler would delay the sessions of this process as long as it runs. One process at a time;
    what it could not compile or store is compiled, and reported, by the session.
    """
    async with _compiling:
        if not await asyncio.to_thread(is_compiled_for, actuator, law):
            await _compile(law, "--actuator", actuator)


async def compile_arm(actuators: Sequence[str], law: str) -> None:
    """Compile the loop of an arm and a law for the actuators of its joints, as `compile_for`."""
    async with _compiling:
        is_known = all(name in list_mechanism_names() for name in actuators)
        if is_known and not await asyncio.to_thread(_is_compiled_for_arm, actuators, law):
            await _compile(law, "--arm", ",".join(actuators))


def _is_compiled_for_arm(actuators: Sequence[str], law: str) -> bool:
    plants = [Actuator.__name__ if name == SVSA else _OTHER_LOOP for name in actuators]
    count = len(plants)
    plants = plants[:1] if len(set(plants)) == 1 else plants
    inertia = f"Arm(UniTuple(UniTuple(float64 x {count}) x {count})"
    texts = map(str, advance_arm._cache.list_types())
    is_compiled = any(inertia in text and _PLANT.findall(text) == plants for text in texts)
    return is_compiled and all(is_compiled_for(name, law) for name in actuators)


async def _compile(*arguments: str) -> None:
    if not can_store(advance):
        return
    _begun[:] = [time.monotonic()]
    process = await asyncio.create_subprocess_exec(
        *build_child(COMPILE),
        "compile",
        *arguments,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        await process.wait()
    finally:
        _begun.clear()
        if process.returncode is None:
            process.kill()
            await process.wait()

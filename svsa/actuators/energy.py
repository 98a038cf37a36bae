"""Machine code of an elastic energy: torque, stiffness and their derivatives from U(φ, s).

sympy differentiates U once. The generated text is cached with the compiled code
(`svsa.numerics.code_cache`), so that later starts need neither sympy nor the compiler. The
functions are called by their address: the loop and the control laws are compiled once for all
actuators of this kind.
"""

import hashlib
import inspect
import math
import sys
from contextlib import suppress
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

import numba
from numba.core import types

from svsa.actuators.energy_source import reject_energy, write_source
from svsa.actuators.mechanism import MAX_ELASTIC, Mechanism
from svsa.actuators.spring import SpringDerivatives, SpringState, SpringTorques, StiffnessMargin
from svsa.numerics.cache_folder import choose_root, make_folder
from svsa.numerics.code_cache import read_sealed, write_sealed
from svsa.numerics.exported import find_address

_GIVEN = [types.float64] * (2 + MAX_ELASTIC)
RESULTS: dict[str, Any] = {
    "compute_torques": numba.typeof(SpringTorques(*[0.0] * 2)),
    "compute_margin": numba.typeof(StiffnessMargin(SpringTorques(*[0.0] * 2), *[0.0] * 2)),
    "compute_state": numba.typeof(
        SpringState(SpringTorques(*[0.0] * 2), SpringDerivatives(*[0.0] * 9))
    ),
    "compute_energy": types.float64,
}
"""The functions of an energy and their results."""
_TESTED = 33
"""Number of values of s at which an energy is tested."""
_RELAXED_RAD = 1e-9
"""Largest deflection at which an energy may have its torque of zero: rounding."""


class Energy(NamedTuple):
    """The functions of an energy, of (s, φ, parameters): compiled, and their addresses."""

    functions: dict[str, Any]
    addresses: dict[str, int]


@cache
def compile_energy(mechanism: Mechanism) -> Energy:
    """Compile the functions of an actuator's energy, or load them from the cache.

    Args:
        mechanism: The actuator.

    Returns:
        Its functions, in this process.

    Raises:
        ParameterError: If the energy is not smooth, has a torque or no positive stiffness at φ = 0,
            or has a stiffness that does not depend on s.
    """
    module = _load_module(mechanism)
    functions, addresses = {}, {}
    for name, result in RESULTS.items():
        function = getattr(module, name)
        functions[name] = function
        addresses[name] = find_address(function, result(*_GIVEN))
    energy = Energy(functions, addresses)
    _check_stiffness(mechanism, energy)
    return energy


def _check_stiffness(mechanism: Mechanism, energy: Energy) -> None:
    """Reject an energy whose stiffness at φ = 0 is not positive or not monotonic in s.

    Also one with a torque at φ = 0: a run starts there, at rest.
    """
    low, high = mechanism.coordinate
    values = [*mechanism.list_elastic(mechanism.prototype), *[0.0] * MAX_ELASTIC][:MAX_ELASTIC]
    slopes = []
    for i in range(_TESTED):
        s = low + (high - low) * i / (_TESTED - 1)
        torques, derivatives = energy.functions["compute_state"](s, 0.0, *values)
        if not 0.0 < derivatives.sigma < math.inf:
            sigma = derivatives.sigma
            text = f"its stiffness at φ = 0 and s = {s:.4g} is {sigma:.4g} N·m/rad, not > 0"
            raise reject_energy(mechanism, text)
        if abs(torques.torque) > _RELAXED_RAD * derivatives.sigma:
            text = f"its torque at φ = 0 and s = {s:.4g} is {torques.torque:.4g} N·m, not 0"
            raise reject_energy(mechanism, text)
        slopes.append(derivatives.sigma_mu)
    if not (min(slopes) > 0.0 or max(slopes) < 0.0):
        raise reject_energy(
            mechanism, f"its stiffness at φ = 0 is not monotonic in s, {low:g} … {high:g}"
        )


def _load_module(mechanism: Mechanism) -> ModuleType:
    """The module with the functions; from the cache if the same energy was differentiated."""
    name = f"svsa_energy_{mechanism.name}_{_compute_digest(mechanism)}"
    text, path = None, f"<{name}>"
    if (root := choose_root()) is not None:
        path = root / "energies" / f"{name}.py"
        text = read_sealed(path)
    if text is None:
        text = write_source(mechanism).encode()
        try:
            if isinstance(path, Path):
                make_folder(path.parent)
                write_sealed(path, text)
        except OSError:  # for example a read-only cache
            path = f"<{name}>"
    # Not imported: Python would store its code in a file of its own, which can be damaged, too.
    module = ModuleType(name)
    sys.modules[name] = module
    exec(compile(text, path, "exec"), module.__dict__)  # noqa: S102 (own text)
    return module


def _compute_digest(mechanism: Mechanism) -> str:
    """Compute a digest that changes with the energy, or with the code that differentiates it."""
    code = mechanism.energy.__code__
    digest = hashlib.sha256(Path(__file__).read_bytes())
    for used in (write_source, find_address):
        digest.update(Path(inspect.getfile(used)).read_bytes())
    digest.update(repr((code.co_qualname, mechanism.elastic)).encode())
    with suppress(OSError):
        digest.update(inspect.getsource(inspect.getmodule(code) or mechanism.energy).encode())
    digest.update(code.co_code + repr((code.co_consts, code.co_firstlineno)).encode())
    return digest.hexdigest()[:16]

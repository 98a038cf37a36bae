"""Machine code of an elastic energy: torque, stiffness and their derivatives from U(φ, s).

sympy differentiates U once. The text of the result is kept with the compiled code
(`svsa.numerics.code_cache`), so that later starts need neither sympy nor the compiler. The
functions are called by their address: the loop and the control laws are compiled once for every
actuator of this kind, not once for each.
"""

import hashlib
import importlib.util
import inspect
import math
import os
import sys
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any, NamedTuple

import numba
from numba.core import types

from svsa.actuators.mechanism import MAX_ELASTIC, Mechanism
from svsa.actuators.spring import SpringDerivatives, SpringTorques
from svsa.errors import ParameterError, Violation
from svsa.numerics.code_cache import choose_root

_PARAMETERS = [f"e{i}" for i in range(MAX_ELASTIC)]
_SIGNATURE = ", ".join(["s", "phi", *_PARAMETERS])
_GIVEN = [types.float64] * (2 + MAX_ELASTIC)
RESULTS: dict[str, Any] = {
    "compute_torques": numba.typeof(SpringTorques(*[0.0] * 2)),
    "compute_stiffness": types.float64,
    "compute_derivatives": numba.typeof(SpringDerivatives(*[0.0] * 9)),
    "compute_determinant": types.float64,
    "compute_energy": types.float64,
}
"""The functions of an energy and what each returns."""
_PAIRS = {("sin", "cos"): "sin_cos", ("sinh", "cosh"): "sinh_cosh"}
_SINGLE = ("exp", "log", "tanh")
_HEAD = '''"""Derivatives of an elastic energy, written by `svsa.actuators.energy`."""

from math import sqrt

from svsa.actuators.spring import SpringDerivatives, SpringTorques
from svsa.numerics.compilation import compiled
from svsa.numerics.exponential import exp, log, sinh_cosh, tanh
from svsa.numerics.trigonometry import sin_cos
'''
_TESTED = 33
"""At how many values of s an energy is tested."""


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
        ParameterError: If the energy is not smooth, has no positive stiffness at φ = 0, or its
            stiffness does not depend on s.
    """
    module = _load_module(mechanism)
    functions, addresses = {}, {}
    for name, result in RESULTS.items():
        function = getattr(module, name)
        signature = result(*_GIVEN)
        function.compile(signature)
        compilation = function.get_compile_result(signature)
        wrapper = compilation.fndesc.llvm_cfunc_wrapper_name
        functions[name] = function
        addresses[name] = compilation.library.get_pointer_to_function(wrapper)
    energy = Energy(functions, addresses)
    _check_stiffness(mechanism, energy)
    return energy


def _check_stiffness(mechanism: Mechanism, energy: Energy) -> None:
    """Reject an energy whose stiffness at φ = 0 is not positive or not monotonic in s."""
    low, high = mechanism.coordinate
    values = [*mechanism.list_elastic(mechanism.prototype), *[0.0] * MAX_ELASTIC][:MAX_ELASTIC]
    slopes = []
    for i in range(_TESTED):
        s = low + (high - low) * i / (_TESTED - 1)
        found = energy.functions["compute_derivatives"](s, 0.0, *values)
        if not 0.0 < found.sigma < math.inf:
            text = f"its stiffness at φ = 0 and s = {s:.4g} is {found.sigma:.4g} N·m/rad, not > 0"
            raise _reject(mechanism, text)
        slopes.append(found.sigma_mu)
    if not (min(slopes) > 0.0 or max(slopes) < 0.0):
        raise _reject(
            mechanism, f"its stiffness at φ = 0 is not monotonic in s, {low:g} … {high:g}"
        )


def _reject(mechanism: Mechanism, finding: str) -> ParameterError:
    return ParameterError(Violation("energy", mechanism.name, "", "", finding=finding))


def _load_module(mechanism: Mechanism) -> ModuleType:
    """The module with the functions; from the cache if the same energy was differentiated."""
    name = f"svsa_energy_{mechanism.name}_{_compute_digest(mechanism)}"
    path = choose_root() / "energies" / f"{name}.py"
    if not path.exists():
        text = write_source(mechanism)
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            new = path.with_suffix(f".{os.getpid()}")
            new.write_text(text, encoding="utf-8")
            new.replace(path)
        except OSError:  # a cache that can only be read
            module = ModuleType(name)
            exec(compile(text, f"<{name}>", "exec"), module.__dict__)  # noqa: S102 (own text)
            return module
    spec = importlib.util.spec_from_file_location(name, path)
    assert spec is not None and spec.loader is not None, path  # noqa: S101 (a file's name)
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module


def _compute_digest(mechanism: Mechanism) -> str:
    """What changes with the energy, or with how it is differentiated."""
    code = mechanism.energy.__code__
    digest = hashlib.sha256(Path(__file__).read_bytes())
    digest.update(repr((code.co_qualname, mechanism.elastic)).encode())
    with suppress(OSError):
        digest.update(inspect.getsource(inspect.getmodule(code) or mechanism.energy).encode())
    digest.update(code.co_code + repr((code.co_consts, code.co_firstlineno)).encode())
    return digest.hexdigest()[:16]


def write_source(mechanism: Mechanism) -> str:
    """Differentiate the energy and write the text of its functions.

    Args:
        mechanism: The actuator.

    Returns:
        Text of a Python module.

    Raises:
        ParameterError: If the energy is not smooth, contains a function that the lab does not
            compute with, or its stiffness does not depend on s.
    """
    import sympy  # an import takes 0.3 s: only where an energy is new

    s, phi = sympy.symbols("s phi", real=True)
    values = sympy.symbols(_PARAMETERS[: len(mechanism.elastic)], positive=True)
    named = SimpleNamespace(**dict(zip(mechanism.elastic, values, strict=True)))
    U = sympy.sympify(mechanism.energy(phi, s, named, sympy))
    foreign = U.free_symbols - {s, phi, *values}
    if foreign:
        raise _reject(mechanism, f"it depends on {', '.join(map(str, foreign))}")
    torque, reaction = U.diff(phi), U.diff(s)
    sigma = torque.diff(phi)
    _check_smooth(mechanism, sympy, [U, sigma.diff(phi, 2), sigma.diff(s, 2)])
    if sympy.simplify(sigma.diff(s)) == 0:
        raise _reject(mechanism, "its stiffness ∂²U/∂φ² does not depend on s")
    determinant = sigma * sigma.diff(s) - torque.diff(s) * sigma.diff(phi)
    found = {
        "compute_torques": [torque, reaction],
        "compute_stiffness": [sigma],
        "compute_derivatives": [
            torque,
            torque.diff(s),
            torque.diff(s, 2),
            sigma,
            sigma.diff(phi),
            sigma.diff(s),
            sigma.diff(phi, 2),
            sigma.diff(phi, s),
            sigma.diff(s, 2),
        ],
        "compute_determinant": [determinant / determinant.subs(phi, 0)],
        "compute_energy": [U],
    }
    write = _build_writer(mechanism, sympy)
    return _HEAD + "".join(write(name, expressions) for name, expressions in found.items())


def _check_smooth(mechanism: Mechanism, sympy: Any, expressions: list[Any]) -> None:
    names = ("Abs", "sign", "Max", "Min", "Piecewise", "Heaviside", "DiracDelta", "floor")
    bends = tuple(getattr(sympy, name) for name in (*names, "ceiling", "Mod", "Derivative"))
    for expression in expressions:
        found = expression.atoms(*bends)
        if found:
            raise _reject(mechanism, f"it is not smooth: it contains {next(iter(found))}")


def _build_writer(mechanism: Mechanism, sympy: Any) -> Callable[[str, list[Any]], str]:
    """A function that writes a function of these expressions."""
    from sympy.printing.pycode import PythonCodePrinter

    class Printer(PythonCodePrinter):
        """Powers as products: a library's `pow` differs from machine to machine."""

        def _print_Pow(self, expr: Any, rational: bool = False, sqrt: str = "") -> str:  # noqa: N802
            base, exponent = expr.as_base_exp()
            twice = 2 * exponent
            if not twice.is_Integer or abs(twice) > 32:
                raise _reject(mechanism, f"it contains the power {expr}")
            whole, half = divmod(abs(int(twice)), 2)
            text = self.parenthesize(base, 1000)
            product = "*".join([text] * whole + [f"sqrt({self._print(base)})"] * half)
            return f"(1.0/({product}))" if int(twice) < 0 else f"({product})"

        def _print_Rational(self, expr: Any) -> str:  # noqa: N802
            return f"({float(expr.p)!r}/{float(expr.q)!r})"

        def _print_Function(self, expr: Any) -> str:  # noqa: N802
            name = type(expr).__name__
            if name not in _SINGLE:
                raise _reject(mechanism, f"it contains the function {name}")
            return f"{name}({self._print(expr.args[0])})"

        _print_exp = _print_log = _print_tanh = _print_Function

    printer = Printer({"fully_qualified_modules": False})

    def write(name: str, expressions: list[Any]) -> str:
        pairs, expressions = _name_pairs(sympy, expressions)
        lines = [""] * 2 + ["", "@compiled", f"def {name}({_SIGNATURE}):"]
        symbols = (sympy.Symbol(f"x{i}") for i in range(10_000))
        for function, argument, names in pairs:
            lines.append(f"    {', '.join(names)} = {function}({printer.doprint(argument)})")
        common, results = sympy.cse(expressions, symbols=symbols)
        lines += [f"    {symbol} = {printer.doprint(value)}" for symbol, value in common]
        texts = [f"1.0 * ({printer.doprint(value)})" for value in results]
        kind = {2: "SpringTorques", 9: "SpringDerivatives"}.get(len(texts), "")
        lines.append(f"    return {kind}({', '.join(texts)})")
        return "\n".join(lines)[1:] + "\n"

    return write


def _name_pairs(sympy: Any, expressions: list[Any]) -> tuple[list[Any], list[Any]]:
    """Replace sin, cos, sinh and cosh by names of values that are computed in pairs."""
    pairs: list[tuple[str, Any, list[str]]] = []
    functions = {getattr(sympy, name): pair for pair in _PAIRS for name in pair}
    while True:
        whole = sympy.Tuple(*expressions)
        found = whole.atoms(*functions)
        inner = [one for one in found if not one.args[0].atoms(*functions)]
        if not inner:
            return pairs, expressions
        one = min(inner, key=sympy.default_sort_key)
        pair, argument = functions[type(one)], one.args[0]
        names = [f"{name}{len(pairs)}" for name in pair]
        pairs.append((_PAIRS[pair], argument, names))
        replaced = {
            getattr(sympy, name)(argument): sympy.Symbol(new)
            for name, new in zip(pair, names, strict=True)
        }
        expressions = [expression.xreplace(replaced) for expression in expressions]

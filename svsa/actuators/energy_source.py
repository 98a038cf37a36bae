"""Generated Python code of an elastic energy's functions: derivatives of U(φ, s) by sympy."""

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

from svsa.actuators.mechanism import MAX_ELASTIC, Mechanism
from svsa.errors import ParameterError, Violation

_PARAMETERS = [f"e{i}" for i in range(MAX_ELASTIC)]
SIGNATURE = ", ".join(["s", "phi", *_PARAMETERS])
_RETURNED = {
    "compute_torques": "SpringTorques({}, {})",
    "compute_margin": f"StiffnessMargin(compute_torques({SIGNATURE}), {{}}, {{}})",
    "compute_state": f"SpringState(compute_torques({SIGNATURE}), SpringDerivatives("
    + ", ".join(["{}"] * 9)
    + "))",
    "compute_energy": "{}",
}
"""Results of each generated function. Torques have the same bits in each of them."""
_PAIRS = {("sin", "cos"): "sin_cos", ("sinh", "cosh"): "sinh_cosh"}
_SINGLE = ("exp", "log", "tanh")
_HEAD = '''"""Derivatives of an elastic energy, written by `svsa.actuators.energy_source`."""

from math import sqrt

from svsa.actuators.spring import SpringDerivatives, SpringState, SpringTorques, StiffnessMargin
from svsa.numerics.compilation import compiled
from svsa.numerics.exponential import exp, log, sinh_cosh, tanh
from svsa.numerics.trigonometry import sin_cos, sin_versin
'''
_MAX_POWER = 32
_SHORT = 60


def reject_energy(mechanism: Mechanism, finding: str) -> ParameterError:
    """Build the error of an actuator's invalid energy."""
    return ParameterError(Violation("energy", mechanism.name, "", "", finding=finding))


def write_source(mechanism: Mechanism) -> str:
    """Differentiate the energy and generate the code of its functions.

    Args:
        mechanism: The actuator.

    Returns:
        Text of a Python module.

    Raises:
        ParameterError: If the energy is not smooth, is not an expression of the symbols, contains a
            function that the lab does not support, or has a stiffness that does not depend on s.
    """
    import sympy  # the import takes 0.3 s and is needed only for a new energy

    s, phi = sympy.symbols("s phi", real=True)
    U = _read_energy(mechanism, sympy, s, phi)
    torque, reaction = U.diff(phi), U.diff(s)
    sigma = torque.diff(phi)
    _check_smooth(mechanism, sympy, [U, sigma.diff(phi, 2), sigma.diff(s, 2)])
    _check_parts(mechanism, sympy, U)
    slope = sigma.diff(s)
    if not mechanism.has_stiffness_motor:
        if any(
            _shorten(sympy, derivative) != 0 for derivative in (reaction, slope, sigma.diff(phi))
        ):
            finding = "without a stiffness motor it is that of a linear spring, ½ k φ²"
            raise reject_energy(mechanism, finding)
        # The SVSA's lever has σ̇ = ṡ: A(x) stays regular, and the error σ_d − σ = 0 never moves
        # motor 2.
        slope = sympy.Integer(1)
    elif _shorten(sympy, slope) == 0:
        raise reject_energy(mechanism, "its stiffness ∂²U/∂φ² does not depend on s")
    relaxed = (
        derivative.subs(phi, 0)
        for derivative in (torque, sigma, sigma.diff(phi), sigma.diff(phi, 2))
    )
    if any(value.has(sympy.nan, sympy.zoo, sympy.oo, -sympy.oo) for value in relaxed):
        raise reject_energy(mechanism, "it is not smooth: a derivative is not finite at φ = 0")
    determinant = sigma * slope - torque.diff(s) * sigma.diff(phi)
    results = {
        "compute_torques": [torque, reaction],
        "compute_margin": [
            sigma,
            _shorten(sympy, determinant / determinant.subs(phi, 0)),
        ],
        "compute_state": [
            torque,
            torque.diff(s),
            torque.diff(s, 2),
            sigma,
            sigma.diff(phi),
            slope,
            sigma.diff(phi, 2),
            sigma.diff(phi, s),
            sigma.diff(s, 2),
        ],
        "compute_energy": [U],
    }
    write = _build_writer(mechanism, sympy)
    return _HEAD + "".join(write(name, expressions) for name, expressions in results.items())


def _read_energy(mechanism: Mechanism, sympy: Any, s: Any, phi: Any) -> Any:
    """Call the actuator's function with symbols.

    Raises:
        ParameterError: If it fails, or does not return an expression of these symbols.
    """
    values = sympy.symbols(_PARAMETERS[: len(mechanism.elastic)], positive=True)
    named = SimpleNamespace(**dict(zip(mechanism.elastic, values, strict=True)))
    try:
        U = sympy.sympify(mechanism.energy(phi, s, named, sympy), strict=True)
    except Exception as error:
        first, *_ = str(error).strip().split("\n")
        finding = f"it is not an expression of symbols: {type(error).__name__}: {first}"
        raise reject_energy(mechanism, finding) from error
    if not isinstance(U, sympy.Expr):
        finding = f"it is not an expression of symbols, but of type {type(U).__name__}"
        raise reject_energy(mechanism, finding)
    foreign = U.free_symbols - {s, phi, *values}
    if foreign:
        raise reject_energy(mechanism, f"it depends on {', '.join(map(str, foreign))}")
    return U.replace(
        lambda part: part.is_Pow and part.exp.is_Float and float(2 * part.exp).is_integer(),
        lambda part: part.base ** sympy.Rational(part.exp),
    )


def _check_parts(mechanism: Mechanism, sympy: Any, U: Any) -> None:
    """Reject functions and constants that the generated code cannot compute."""
    names = [*_SINGLE, *(name for pair in _PAIRS for name in pair)]
    functions = tuple(getattr(sympy, name) for name in names)
    sums = sympy.Add, sympy.Mul, sympy.Pow, sympy.Symbol, sympy.NumberSymbol
    for part in sympy.preorder_traversal(U):
        if isinstance(part, sympy.Function) and not isinstance(part, functions):
            known = ", ".join(names)
            finding = f"it contains the function {type(part).__name__}; the lab computes {known}"
            raise reject_energy(mechanism, finding)
        if not (isinstance(part, (*sums, *functions)) or (part.is_Number and part.is_finite)):
            raise reject_energy(mechanism, f"it contains {part}")


def _check_smooth(mechanism: Mechanism, sympy: Any, expressions: list[Any]) -> None:
    names = ("Abs", "sign", "Max", "Min", "Piecewise", "Heaviside", "DiracDelta", "floor")
    bends = tuple(getattr(sympy, name) for name in (*names, "ceiling", "Mod", "Derivative"))
    for expression in expressions:
        bent = expression.atoms(*bends)
        if bent:
            raise reject_energy(mechanism, f"it is not smooth: it contains {next(iter(bent))}")


def _build_writer(mechanism: Mechanism, sympy: Any) -> Callable[[str, list[Any]], str]:
    """A function that writes a function of these expressions."""
    from sympy.printing.precedence import PRECEDENCE
    from sympy.printing.pycode import PythonCodePrinter

    class Printer(PythonCodePrinter):
        """Powers as products: a library's `pow` differs from machine to machine.

        In sums and products, what is computed last comes last: nothing else waits for it.
        """

        levels: dict[str, int]

        def _sort(self, parts: tuple[Any, ...]) -> list[Any]:
            return sorted(
                parts, key=lambda part: (self.find_level(part), sympy.default_sort_key(part))
            )

        def find_level(self, expr: Any) -> int:
            return max(
                (self.levels.get(symbol.name, 0) for symbol in expr.free_symbols), default=-1
            )

        def _print_Add(self, expr: Any, order: Any = None) -> str:  # noqa: N802
            first, *others = self._sort(expr.args)
            text = self._print(first)
            for part in others:
                minus = part.could_extract_minus_sign()
                written = self.parenthesize(-part if minus else part, PRECEDENCE["Mul"])
                text += f" {'-' if minus else '+'} {written}"
            return text

        def _print_Mul(self, expr: Any) -> str:  # noqa: N802
            minus = expr.could_extract_minus_sign()
            parts = self._sort(sympy.Mul.make_args(-expr if minus else expr))
            text = "*".join(self.parenthesize(part, PRECEDENCE["Mul"]) for part in parts)
            return f"-{text}" if minus else text

        def _print_Pow(self, expr: Any, rational: bool = False, sqrt: str = "") -> str:  # noqa: N802
            base, exponent = expr.as_base_exp()
            # `_name_shared` leaves whole positive powers, which repeated squaring computes with few
            # products.
            text = self.parenthesize(base, 1000)
            square = f"({text}*{text})"
            pairs, rest = divmod(int(exponent), 2)
            return f"({'*'.join([square] * pairs + [text] * rest)})"

        def _print_Rational(self, expr: Any) -> str:  # noqa: N802
            return f"({float(expr.p)!r}/{float(expr.q)!r})"

        def _print_Function(self, expr: Any) -> str:  # noqa: N802
            return f"{type(expr).__name__}({self._print(expr.args[0])})"

        def _print_NumberSymbol(self, expr: Any) -> str:  # noqa: N802
            return repr(float(expr))

        _print_exp = _print_log = _print_tanh = _print_Function
        _print_Pi = _print_Exp1 = _print_NumberSymbol  # noqa: N815

    def write(name: str, expressions: list[Any]) -> str:
        named, expressions = _name_shared(mechanism, sympy, expressions)
        lines = [""] * 2 + ["", "@compiled", f"def {name}({SIGNATURE}):"]
        symbols = (sympy.Symbol(f"x{i}") for i in range(10_000))
        common, results = sympy.cse(expressions, symbols=symbols)
        named += [(str(symbol), "{}", value) for symbol, value in common]
        printer = Printer({"fully_qualified_modules": False})
        printer.levels = {"s": 1, "phi": 1}
        for names, function, argument in named:
            lines.append(f"    {names} = {function.format(printer.doprint(argument))}")
            level = printer.find_level(argument) if function == "{}" else len(lines)
            printer.levels |= dict.fromkeys(names.split(", "), level)
        texts = [f"1.0 * ({printer.doprint(value)})" for value in results]
        lines.append(f"    return {_RETURNED[name].format(*texts)}")
        return "\n".join(lines)[1:] + "\n"

    return write


def _name_shared(
    mechanism: Mechanism, sympy: Any, expressions: list[Any]
) -> tuple[list[tuple[str, str, Any]], list[Any]]:
    """Name the most expensive shared subexpressions, so that each is computed once.

    sin and cos, sinh and cosh are computed in pairs. A root or a reciprocal is computed once for
    all powers of its base; positive integer powers of a name remain in the expressions.

    Returns:
        The names in order, as (names, text with {} for the argument, argument); the expressions.
    """
    named: list[tuple[str, str, Any]] = []
    functions = {getattr(sympy, name): pair for pair in _PAIRS for name in pair}

    def is_costly(part: Any) -> bool:
        whole = part.is_Pow and part.exp.is_Integer and part.exp > 0
        return type(part) in functions or (part.is_Pow and not whole)

    def list_costly(expression: Any) -> list[Any]:
        return [part for part in expression.atoms(sympy.Pow, *functions) if is_costly(part)]

    while True:
        costly = list_costly(sympy.Tuple(*expressions))
        inner = [term for term in costly if not any(list_costly(part) for part in term.args)]
        if not inner:
            return named, expressions
        innermost = min(inner, key=sympy.default_sort_key)
        if innermost.is_Pow:
            names, replace = _name_powers(mechanism, sympy, innermost, inner, len(named))
            named += names
        else:
            pair, argument = functions[type(innermost)], innermost.args[0]
            names = [f"{name}{len(named)}" for name in pair]
            function = f"{_PAIRS[pair]}({{}})"
            if function == "sin_cos({})" and argument == sympy.Symbol("phi", real=True):
                named.append((f"{names[0]}, versin", "sin_versin({})", argument))
                named.append((names[1], "1.0 - {}", sympy.Symbol("versin")))
            else:
                named.append((", ".join(names), function, argument))
            replace = {
                getattr(sympy, name)(argument): sympy.Symbol(new)
                for name, new in zip(pair, names, strict=True)
            }
        expressions = [expression.xreplace(replace) for expression in expressions]


def _name_powers(
    mechanism: Mechanism, sympy: Any, shared: Any, powers: list[Any], count: int
) -> tuple[list[tuple[str, str, Any]], dict[Any, Any]]:
    """Name the root and the reciprocal of a power's base, and the replacements of powers."""
    base = shared.base
    alike = [power for power in powers if power.is_Pow and power.base in (base, -base)]
    half, roots = sympy.Rational(1, 2), [power for power in alike if not power.exp.is_Integer]
    unit = half if roots else sympy.Integer(1)
    if roots:
        base = roots[0].base
    elif base.could_extract_minus_sign():
        base = -base
    root, inverse = sympy.Symbol(f"root{count}"), sympy.Symbol(f"inverse{count}")
    names, replace = [], {}
    if unit == half:
        alike = [power for power in alike if power.base == base]
        names.append((str(root), "sqrt({})", base))
    if any(power.exp.is_negative for power in alike):
        names.append((str(inverse), "1.0/({})", base if unit == 1 else root))
    for power in alike:
        size = abs(power.exp / unit)
        if not size.is_Integer or size > _MAX_POWER:
            raise reject_energy(mechanism, f"it contains the power {power}")
        sign = -1 if power.base != base and power.exp % 2 else 1
        replace[power] = sign * (inverse if power.exp.is_negative else root) ** size
    return names, replace


def _shorten(sympy: Any, expression: Any) -> Any:
    """Return an expression with fewer operations, by cos² = 1 − sin² and cosh² = 1 + sinh².

    Not by sympy's `trigsimp`, which took 1.7 s for one energy. A long expression rarely gets
    shorter.
    """
    factored = sympy.factor_terms(expression)
    if sympy.count_ops(factored) > _SHORT:
        return factored
    expanded = sympy.expand_trig(factored)
    squares = {}
    for power in expanded.atoms(sympy.Pow):
        base, (pairs, rest) = power.base, divmod(power.exp, 2)
        if pairs.is_Integer and pairs > 0 and isinstance(base, sympy.cos | sympy.cosh):
            x = base.args[0]
            is_cos = isinstance(base, sympy.cos)
            square = 1 - sympy.sin(x) ** 2 if is_cos else 1 + sympy.sinh(x) ** 2
            squares[power] = square**pairs * base**rest
    return min(factored, sympy.cancel(expanded.xreplace(squares)), key=sympy.count_ops)

"""Gains: poles ↔ coefficients of the error polynomials, and their stability (Eq 25)."""

from collections.abc import Sequence
from functools import lru_cache
from typing import ClassVar, Self

import numpy as np
from pydantic import model_validator

from svsa.control.parameters import LawParameters
from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import Number, quantity

FASTEST_POLE_RAD_PER_S = 1000.0


class Gains(LawParameters):
    """Coefficients of Eq 25. Both polynomials must be Hurwitz; otherwise rejected with their
    roots.
    """

    must_be_stable: ClassVar[bool] = True

    position_coefficients: tuple[Number, Number, Number, Number] = quantity(
        "s⁻⁴ … s⁻¹", "c0 … c3 of s⁴ + c3 s³ + c2 s² + c1 s + c0 (Eq 25)"
    )
    stiffness_coefficients: tuple[Number, Number] = quantity(
        "s⁻², s⁻¹", "c0, c1 of s² + c1 s + c0 (Eq 25)"
    )

    @classmethod
    def from_poles(cls, position: Sequence[complex], stiffness: Sequence[complex]) -> Self:
        """Compute the gains that place the closed-loop poles (Eq 25).

        Args:
            position: Four poles of the position error, rad/s; complex ones in conjugate pairs.
            stiffness: Two poles of the stiffness error, rad/s.

        Returns:
            The gains.

        Raises:
            ParameterError: If a pole has no conjugate, or is not stable.
        """
        c0, c1, c2, c3 = compute_coefficients("position_poles_rad_per_s", position, 4)
        s0, s1 = compute_coefficients("stiffness_poles_rad_per_s", stiffness, 2)
        return cls(position_coefficients=(c0, c1, c2, c3), stiffness_coefficients=(s0, s1))

    def describe(self) -> dict[str, str]:
        """Describe the poles of both polynomials.

        Returns:
            Geometric mean of the poles by symbol, rad/s, as text.
        """
        (c0, *_), (s0, _) = self.position_coefficients, self.stiffness_coefficients
        return {"ωq": f"{c0**0.25:.3g}", "ωσ": f"{s0**0.5:.3g}"}

    @property
    def position_roots(self) -> list[complex]:
        """Compute the four roots of the position polynomial, rad/s."""
        return compute_roots(self.position_coefficients)

    @property
    def stiffness_roots(self) -> list[complex]:
        """Compute the two roots of the stiffness polynomial, rad/s."""
        return compute_roots(self.stiffness_coefficients)

    @model_validator(mode="after")
    def _check_hurwitz(self) -> Self:
        for name in ("position_coefficients", "stiffness_coefficients"):
            coefficients = getattr(self, name)
            roots = compute_roots(coefficients)
            unstable = [root for root in roots if self.must_be_stable and not root.real < 0.0]
            fast = [root for root in roots if abs(root) > FASTEST_POLE_RAD_PER_S]
            if not unstable and not fast:
                continue
            if unstable:
                bound = "Hurwitz: every root left of the imaginary axis"
                side = "right of" if unstable[0].real > 0.0 else "on"
                finding = _format_list(unstable, f"lies {side} the imaginary axis")
            else:
                bound = f"slower than {FASTEST_POLE_RAD_PER_S:g} rad/s"
                finding = _format_list(fast, f"is faster than {FASTEST_POLE_RAD_PER_S:g} rad/s")
            bound += f"; the roots are {describe_roots(roots)} rad/s"
            raise ParameterError(Violation(name, list(coefficients), "", bound, finding=finding))
        return self


class UncheckedGains(Gains):
    """Gains to evaluate, stable or not; the simulation may fail.

    Files and records contain only stable `Gains`.
    """

    must_be_stable: ClassVar[bool] = False


def compute_coefficients(name: str, poles: Sequence[complex], order: int) -> tuple[float, ...]:
    """c0 … c_{n−1} of the monic polynomial with these roots (Eq 25), lowest power first.

    Args:
        name: Name of the value in the error message.
        poles: The roots, rad/s; `order` numbers.
        order: Degree of the polynomial.

    Returns:
        The coefficients, in powers of rad/s.

    Raises:
        ParameterError: If the number of poles is wrong, or a complex pole has no conjugate.
    """
    values = np.asarray(poles, dtype=complex)
    if values.shape != (order,) or not np.all(np.isfinite(values)):
        raise ParameterError(Violation(name, list(poles), "rad/s", f"{order} finite poles"))
    polynomial = np.poly(values)
    if np.iscomplexobj(polynomial):
        bound = "real, or in conjugate pairs"
        raise ParameterError(Violation(name, list(poles), "rad/s", bound))
    return tuple(float(c) for c in polynomial[:0:-1])


def compute_roots(coefficients: Sequence[float]) -> list[complex]:
    """Compute the roots of s^n + c_{n−1} s^{n−1} + … + c0 (Eq 25), rad/s, slowest first."""
    return list(_find_roots(tuple(coefficients)))


@lru_cache(maxsize=256)
def _find_roots(coefficients: tuple[float, ...]) -> tuple[complex, ...]:
    roots = np.roots([1.0, *coefficients[::-1]])
    slowest_first = sorted(map(complex, roots), key=lambda root: (-root.real, root.imag))
    return tuple(slowest_first)


def describe_roots(roots: Sequence[complex]) -> str:
    """Format roots, rad/s: "24.4 ± 24.4j, -60", a conjugate pair once."""
    return ", ".join(
        f"{root.real:.4g}" if root.imag == 0.0 else f"{root.real:.4g} ± {root.imag:.4g}j"
        for root in roots
        if root.imag >= 0.0
    )


def _format_list(roots: Sequence[complex], finding: str) -> str:
    """Format the finding with its most critical root, which represents its conjugate as well."""
    return f"{describe_roots([max(roots, key=lambda root: (root.real, root.imag))])} {finding}"

"""Stability margins of laws as text, for the command line and the laws' pages."""

from collections.abc import Iterator

from svsa.analysis.design.margins import SYMBOLS, GainRange, JointError, Margins, compute_margins
from svsa.analysis.design.report import build_configuration
from svsa.simulation.plant.effects import RIG

HEADS = ("modulus", "delay", "gain of u1", "gain of u2", "joint error")
STIFFNESSES = (15.0, 60.0)
_LEAST_SHARE = 0.005


def compute_law_margins(
    law: str, sigmas: tuple[float, ...] = STIFFNESSES
) -> Iterator[tuple[float, Margins]]:
    """Compute the margins of a law with its default parameters, the paper's design and the rig's
    effects.

    Args:
        law: Name of an installed law.
        sigmas: σ_d, N·m/rad.

    Returns:
        (σ, margins) for each stiffness.
    """
    configuration = build_configuration(law, None, None, None).changed(effects=RIG)
    for sigma in sigmas:
        configuration.limits.check_stiffness("stiffness", sigma, sigma)
        yield sigma, compute_margins(configuration, sigma)


def format_margins(margins: Margins) -> tuple[str, ...]:
    """Format margins as the cells of a row, one for each of `HEADS`."""
    if not margins.is_stable:
        return ("unstable", "–", "–", "–", "–")
    note = ", switches at rest" if margins.is_switching else ""
    delay = "any" if margins.delay_s is None else f"{1e3 * margins.delay_s:.1f} ms"
    return (
        f"{margins.modulus:.2f}{note}",
        delay,
        _format_range(margins.gain1),
        _format_range(margins.gain2),
        _format_error(margins.error),
    )


def _format_range(gain_range: GainRange | None) -> str:
    if gain_range is None:
        return "–"
    low = "0" if gain_range.low is None else f"{gain_range.low:.2f}"
    return f"from {low}" if gain_range.high is None else f"{low} – {gain_range.high:.2f}"


def _format_error(joint_error: JointError | None) -> str:
    if joint_error is None:
        return "none found"
    parts = [
        f"{symbol} {error:+.0%}".replace("-", "\N{MINUS SIGN}")
        for symbol, error in zip(SYMBOLS, joint_error.errors, strict=True)
        if abs(error) >= _LEAST_SHARE
    ]
    return f"{joint_error.norm:.2f} ({', '.join(parts)})"

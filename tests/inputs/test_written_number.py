"""Numbers in messages are written without exponents."""

import pytest

import svsa
from svsa.errors import Violation, write_number
from svsa.inputs.checked import check_number


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.0, "0"),
        (0.25, "0.25"),
        (-150.563, "-150.563"),
        (100_000, "100000"),
        (1e6, "1 000 000"),
        (-2.5e6, "-2 500 000"),
        (10**9, "1 000 000 000"),
        (2**63 - 1, "9.22337 × 10¹⁸"),
        (3.2e-9, "3.2 × 10⁻⁹"),
        (1e-4, "0.0001"),
    ],
)
def test_large_and_small_numbers_have_no_exponent(value: float, text: str) -> None:
    assert write_number(value).replace("\N{NARROW NO-BREAK SPACE}", " ") == text


def test_bounds_and_values_have_no_exponent() -> None:
    with pytest.raises(svsa.ParameterError) as refused:
        svsa.Change(at_s=2e7, law="fl")
    message = str(refused.value).replace("\N{NARROW NO-BREAK SPACE}", " ")
    assert message == "at_s is 20 000 000 s: it must be at most 1 000 000 s."
    with pytest.raises(svsa.ParameterError, match=r"from 0 to 1\s000\s000 s"):
        check_number("end_s", "soon", "s", 0.0, 1e6)
    assert Violation("a", 1.23456789e-7, "s", "b").message == (
        "a is 1.23457 × 10⁻⁷ s: it must be b."
    )

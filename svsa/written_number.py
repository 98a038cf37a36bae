"""A number as people write it: 1 000 000 and 3.2 × 10⁻⁹, not 1e+06 and 3.2e-09."""

DIGITS_WRITTEN_OUT = 12
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_NARROW = "\N{NARROW NO-BREAK SPACE}"


def settle_number(value: float, digits: int) -> float:
    """The number with so many digits: where machines differ in the last one, the same."""
    return float(f"{value:.{digits}g}")


def write_number(value: float) -> str:
    """The number to six digits, in groups of three where it is large."""
    text = f"{value:g}"
    digits, _, exponent = text.partition("e")
    if not exponent:
        return text
    power = int(exponent)
    if 0 < power < DIGITS_WRITTEN_OUT:
        return f"{float(text):,.0f}".replace(",", _NARROW)
    return f"{digits} × 10{str(power).translate(_RAISED)}"

"""What people may call themselves."""

LONGEST_NAME = 40
_CONTROLS = r"\u0000-\u001f\u007f-\u009f"
READABLE = rf"^[^{_CONTROLS}]*[^\s{_CONTROLS}][^{_CONTROLS}]*$"


def check_printable(name: str) -> str:
    """The name without what stands around it; raises `ValueError` where it cannot be read."""
    if not name.strip() or not name.isprintable():
        raise ValueError("a text that can be read")
    return name.strip()

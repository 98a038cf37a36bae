"""How the control of a session is asked for, and told."""

from typing import Annotated

from pydantic import AfterValidator, BaseModel, Field

from svsa.checked import Checked, Flag, quantity

LONGEST_NAME = 40
_CONTROLS = r"\u0000-\u001f\u007f-\u009f"
READABLE = rf"^[^{_CONTROLS}]*[^\s{_CONTROLS}][^{_CONTROLS}]*$"


def check_printable(name: str) -> str:
    """The name without what stands around it; raises `ValueError` where it cannot be read."""
    if not name.strip() or not name.isprintable():
        raise ValueError("a text that can be read")
    return name.strip()


class ControlRequest(Checked):
    """Takes control of a session."""

    by: Annotated[
        str,
        Field(max_length=LONGEST_NAME, json_schema_extra={"pattern": READABLE}),
        AfterValidator(check_printable),
    ] = quantity("", "Who is in control, as everybody is told, in printable characters")
    take_over: Flag = quantity("", "Whoever is in control loses it", default=False)


class ControlState(BaseModel):
    """Who may command a session; everybody may watch, pause and stop it."""

    holder: str | None = Field(description="Who is in control; null: everybody may command")
    mine: bool = Field(description="Whether it is the client that this answer is for")
    watching: int = Field(description="Streams of the session that are open")

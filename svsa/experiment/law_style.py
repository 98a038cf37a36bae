"""How a law is called and drawn in pictures and tables."""

from typing import Any

from svsa.control.installed import get_title, list_law_names
from svsa.control.law import NAME

REFERENCE_STYLE = {"color": "#444444", "linestyle": "--", "linewidth": 1.2, "zorder": 3}
LAW_COLORS = ("#0072B2", "#D55E00", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
OWN_COLOR = "#009E73"


def style_law(law: str) -> dict[str, Any]:
    """How the curves of a law look: each that is installed has a colour until they run out."""
    laws = list_law_names()
    color = LAW_COLORS[laws.index(law) % len(LAW_COLORS)] if law in laws else OWN_COLOR
    return {"color": color, "linewidth": 1.3, "label": name_law(law)}


def name_law(law: str) -> str:
    """What controlled, in words: a law's title, "own controller", or a lane as it was called."""
    if law == "own":
        return "own controller"
    return get_title(law) if NAME.fullmatch(law) else law

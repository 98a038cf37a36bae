"""Names and styles of laws in figures and tables."""

from typing import Any

from svsa.control.installed import get_title, list_law_line_styles
from svsa.control.law import NAME

REFERENCE_STYLE = {"color": "#444444", "linestyle": "--", "linewidth": 1.2, "zorder": 3}
COLORS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00")
DASHES = ("-", (0, (6, 2.5)), (0, (2, 1.5)), (0, (7, 2, 1.2, 2)))
FURTHER_DASHES = ((0, (7, 2, 1.2, 2, 1.2, 2)), (0, (3, 1, 1, 1)))
"""From the twenty-first law on."""
OWN_COLOR = "#000000"


def style_law(law: str) -> dict[str, Any]:
    """Return the style of a law's curves, in the same color as on the page.

    There are thirty styles, no two with the same color and dash, neighbours with neither in common.
    A law that is not installed is drawn in black.
    """
    line_style = list_law_line_styles().get(law)
    look = (
        (OWN_COLOR, "-")
        if line_style is None
        else (COLORS[line_style % len(COLORS)], _choose_dash(line_style))
    )
    return {"color": look[0], "linestyle": look[1], "linewidth": 1.3, "label": name_law(law)}


def _choose_dash(line_style: int) -> Any:
    dashes = DASHES if line_style < len(COLORS) * len(DASHES) else FURTHER_DASHES
    return dashes[line_style % len(dashes)]


def name_law(law: str) -> str:
    """Name a controller: a law's title, "own controller", or the lane's own name."""
    return get_title(law) if NAME.fullmatch(law) else law

"""The page has one scale of at most six font sizes, tokens of theme.css."""

import re
from pathlib import Path

SOURCE = Path(__file__).parents[2] / "frontend" / "web" / "src"
RULE = re.compile(r"([^{}]+)\{([^{}]*)\}")
SIZE = re.compile(r"font(?:-size)?: [^;]*\dpx")
OF_DRAWING = re.compile(r"(\btext|-text|-torque|-name)$")
"""Text of a drawing: its size is in the drawing's own units."""


def test_scale_has_at_most_six_sizes() -> None:
    scale = re.findall(r"--size-\d: ([\d.]+px)", (SOURCE / "theme.css").read_text("utf-8"))
    assert 0 < len(set(scale)) <= 6


def test_every_rule_uses_a_size_of_the_scale() -> None:
    others = [
        f"{sheet.name}: {selector.strip()}"
        for sheet in SOURCE.rglob("*.css")
        for selector, rules in RULE.findall(sheet.read_text("utf-8"))
        if SIZE.search(rules) and not OF_DRAWING.search(selector.strip())
    ]
    assert others == []

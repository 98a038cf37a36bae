"""Markdown with equations as HTML that a page may show: no HTML of the text's own gets through."""

from functools import cache

from markdown_it import MarkdownIt
from mdit_py_plugins.dollarmath import dollarmath_plugin


def render_text(text: str) -> str:
    """The HTML of a text; $TeX$ is an element of class `math`, to be typeset where it is shown."""
    return str(_build_renderer().render(text))


@cache
def _build_renderer() -> MarkdownIt:
    renderer = MarkdownIt("commonmark", {"html": False}).enable("table")
    return renderer.use(dollarmath_plugin, double_inline=False, allow_blank_lines=False)

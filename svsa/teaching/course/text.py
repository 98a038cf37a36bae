"""Convert Markdown with equations to safe HTML: HTML in the text is escaped."""

from functools import cache

from markdown_it import MarkdownIt
from mdit_py_plugins.dollarmath import dollarmath_plugin


def render_text(text: str) -> str:
    """Render a text as HTML; $TeX$ becomes an element of class `math` for the page to typeset."""
    return str(_build_renderer().render(text))


@cache
def _build_renderer() -> MarkdownIt:
    renderer = MarkdownIt("commonmark", {"html": False}).enable("table")
    return renderer.use(dollarmath_plugin, double_inline=False, allow_blank_lines=False)

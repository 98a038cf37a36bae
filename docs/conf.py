"""Configuration of the documentation site: `make docs`."""

import logging
import os
import re
import sys
import tempfile
from pathlib import Path
from typing import Any

import jupyter_client
import latex2mathml.converter
from docutils import nodes
from sphinx.application import Sphinx
from sphinx.writers.html5 import HTML5Translator
from traitlets import default

sys.path.insert(0, str(Path(__file__).parent))

# Runs that a tutorial records are not the user's.
os.environ["SVSA_DATA"] = tempfile.mkdtemp(prefix="svsa-docs-")
from reference_pages import write_reference_pages

from svsa import __version__

# Of nbclient, which otherwise reports each notebook that it runs.
logging.getLogger("traitlets").setLevel(logging.WARNING)

project = "SVSA Lab"
author = "SVSA Lab contributors"
copyright = author
version = release = __version__.partition("+")[0]
language = "en"

extensions = ["myst_nb", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
source_suffix = {".md": "myst-nb", ".ipynb": "myst-nb"}
exclude_patterns = ["_build", "**/.ipynb_checkpoints"]
nitpicky = False

myst_enable_extensions = ["colon_fence", "deflist", "dollarmath", "fieldlist"]
myst_dmath_allow_space = False
html_math_renderer = "mathml"
myst_heading_anchors = 3
nb_execution_mode = "cache"
nb_execution_cache_path = str(Path(__file__).parent / "_build" / "executed")
nb_execution_raise_on_error = True
nb_execution_timeout = 300
# What a cell writes to stderr, such as a warning of Python, fails the build.
nb_output_stderr = "error"

autodoc_typehints = "description"
autodoc_member_order = "bysource"
# As entries of their own, fields of named tuples would be described twice.
napoleon_use_ivar = True
python_use_unqualified_type_names = True

html_theme = "furo"
html_title = f"{project} {version}"
html_show_sourcelink = False
html_copy_source = False
html_static_path = ["_static"]
templates_path = ["_templates"]
html_css_files = ["site.css"]


class EncryptedKernelManager(jupyter_client.AsyncKernelManager):
    """Encrypts the connection to a kernel, which otherwise warns that it is plain text."""

    @default("transport_encryption")
    def _require_encryption(self) -> str:
        return "required"


# nbclient, which runs the notebooks for myst-nb, takes the class from here.
jupyter_client.AsyncKernelManager = EncryptedKernelManager


def escape_docstring(*arguments: Any) -> None:
    """Escape what reStructuredText would read as markup: docstrings are plain text.

    An indented block after a paragraph is code.
    """
    lines, escaped = arguments[-1], []
    is_code, last = False, ""
    for number, line in enumerate(lines):
        is_indented = line.startswith("    ")
        begins = is_indented and not lines[number - 1].strip() and not last.endswith(":")
        if begins and not is_code and not last.startswith(" "):
            escaped += ["::", ""]
            is_code = True
        elif line.strip() and not is_indented:
            is_code = False
        escaped.append(line if is_code else re.sub(r"([|*]|_(?=\W|$))", r"\\\1", line))
        last = line or last
    lines[:] = escaped


SUBSCRIPT = re.compile(r"(?<!\w)([^\W\d_][\u0300-\u036f]?)_([a-zα-ω]{1,3}|[0-9A-Z])(?!\w)")


def lower_subscripts(_: Sphinx, document: nodes.document, __: str) -> None:
    """Set the index of a symbol as a subscript, outside code and formulas: q_d, σ_d, a_min."""
    for text in list(document.findall(nodes.Text)):
        if isinstance(text.parent, nodes.literal | nodes.FixedTextElement | nodes.math):
            continue
        parts: list[nodes.Node] = []
        for number, part in enumerate(SUBSCRIPT.split(text.astext())):
            parts.append(nodes.subscript("", part) if number % 3 == 2 else nodes.Text(part))
        if len(parts) > 1:
            text.parent.replace(text, parts)


def write_inline_formula(translator: HTML5Translator, node: nodes.math) -> None:
    """Write a formula in a line as MathML, which browsers draw without a script."""
    translator.body.append(latex2mathml.converter.convert(node.astext()))
    raise nodes.SkipNode


def write_formula(translator: HTML5Translator, node: nodes.math_block) -> None:
    """Write a formula of its own lines as MathML."""
    formula = latex2mathml.converter.convert(node.astext(), display="block")
    translator.body.append(f'<div class="math">{formula}</div>')
    raise nodes.SkipNode


def write_code(translator: HTML5Translator, node: nodes.literal_block) -> None:
    """Write a code block that the keyboard reaches, because a long line makes it scroll."""
    try:
        HTML5Translator.visit_literal_block(translator, node)
    finally:
        translator.body[-1] = translator.body[-1].replace("<pre", '<pre tabindex="0"', 1)


def open_container(translator: HTML5Translator, node: nodes.container) -> None:
    """Open a container; the keyboard reaches one of the theme's, which scrolls."""
    HTML5Translator.visit_container(translator, node)
    if {"table-wrapper", "math-wrapper"} & set(node["classes"]):
        translator.body[-1] = translator.body[-1].replace("<div", '<div tabindex="0"', 1)


def open_cell(translator: HTML5Translator, node: nodes.entry) -> None:
    """Open a cell of a table; an empty one heads no column or row."""
    HTML5Translator.visit_entry(translator, node)
    if not node.astext():
        translator.body[-1] = translator.body[-1].replace("<th", "<td", 1)
        translator.context[-1] = translator.context[-1].replace("</th", "</td", 1)


ACCESSIBLE = {
    nodes.literal_block: (write_code, HTML5Translator.depart_literal_block),
    nodes.container: (open_container, HTML5Translator.depart_container),
    nodes.entry: (open_cell, HTML5Translator.depart_entry),
}
"""Nodes that keyboard or screen reader need otherwise than Sphinx writes them."""

INCLUDED = {
    "../svsa/README.md": "reference/equations.md",
    "../CHANGELOG.md": "reference/changelog.md",
}
"""Files outside `docs`, by their paths from it, and the pages of the site that include them."""


def link_included(_: Sphinx, __: str, source: list[str]) -> None:
    """Let a link to a file outside `docs` lead to the page of the site that includes it."""
    for file, page in INCLUDED.items():
        source[0] = re.sub(rf"(\]\((?:\.\./)*){re.escape(file)}", rf"\1{page}", source[0])


def add_heading_level(_: Sphinx, __: str, ___: str, context: dict, ____: object) -> None:
    """Give the captions of the navigation the level that `role="heading"` needs."""
    tree = context["furo_navigation_tree"]
    context["furo_navigation_tree"] = tree.replace(
        'role="heading"', 'role="heading" aria-level="2"'
    )


def setup(app: Sphinx) -> None:
    """Install the hooks: for docstrings before napoleon, for the navigation after the theme."""
    app.connect("html-page-context", add_heading_level, priority=900)
    app.connect("source-read", link_included)
    for node, hooks in ACCESSIBLE.items():
        app.add_node(node, override=True, html=hooks)
    app.add_html_math_renderer("mathml", (write_inline_formula, None), (write_formula, None))
    app.connect("autodoc-process-docstring", escape_docstring, priority=100)
    app.connect("doctree-resolved", lower_subscripts)


write_reference_pages(Path(__file__).parent / "reference" / "generated")

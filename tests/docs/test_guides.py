"""The commands and the Python code of tutorials and how-to guides run as they are written."""

import os
import sys
from pathlib import Path

import pytest

from tests.docs.guide import LAB, ROOT, needs_lab, read_blocks, run_page

PAGES = [
    *sorted((ROOT / "docs/tutorials").glob("*.md")),
    *sorted((ROOT / "docs/howto").glob("*.md")),
]
RUN = [page for page in PAGES if any(block.is_run for block in read_blocks(page))]
LANGUAGES = {"python", "console", "toml", "text", "yaml", "matlab", "bibtex", "{toctree}"}


def name(page):
    return str(page.relative_to(ROOT / "docs"))


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """An empty folder in which the commands of the lab are found and runs are kept."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("SVSA_DATA", str(tmp_path / "data"))
    monkeypatch.setenv("PATH", f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}")
    monkeypatch.setenv("NO_COLOR", "1")
    return tmp_path


@pytest.mark.exhaustive
@pytest.mark.parametrize("guide", RUN, ids=name)
def test_the_code_of_a_guide_runs(guide, folder, request):
    lab = request.getfixturevalue("lab") if needs_lab(guide) else None
    assert run_page(guide, folder, {LAB: lab.url} if lab else {}) > 0


@pytest.mark.parametrize("guide", PAGES, ids=name)
def test_a_block_is_run_or_states_why_not(guide):
    for block in read_blocks(guide):
        assert block.language in LANGUAGES, f"line {block.line}: {block.language!r}"
        if block.note == "not executed":
            assert len(block.subject) > 10, f"line {block.line}: no reason"


@pytest.mark.parametrize("section", ["tutorials", "howto"])
def test_the_index_of_a_section_lists_each_page(section):
    pages = {page.stem for page in (ROOT / "docs" / section).iterdir()} - {"index"}
    (contents,) = (
        block.text
        for block in read_blocks(ROOT / "docs" / section / "index.md")
        if block.language == "{toctree}"
    )
    assert {line for line in contents.splitlines() if line and line[0] != ":"} == pages

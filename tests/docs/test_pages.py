"""The commands and the Python code of the documentation run unchanged."""

import os

import pytest

from svsa.hardware.emulator.launch import start_emulator
from tests.docs.pages import BENCH, INSTALL, LAB, ROOT, needs_lab, read_blocks, start_page
from tests.hardware.live_bench import start_live_emulator, write_bench
from tests.lab import run_lab

TUTORIALS = ROOT / "docs" / "tutorials"
GUIDES = [*sorted(TUTORIALS.glob("*.md")), *sorted((ROOT / "docs/howto").glob("*.md"))]
PAGES = ("README.md", "docs/grading.md", "docs/scripting.md", "docs/explanation/arm.md")
EXAMPLES = [ROOT / name for name in PAGES]
ON_BENCH = TUTORIALS / "emulated_bench.md"
OWN_ACTUATOR = TUTORIALS / "own_actuator.md"
RUN = [
    page
    for page in [*GUIDES, *EXAMPLES]
    if page not in (ON_BENCH, OWN_ACTUATOR) and any(block.is_run for block in read_blocks(page))
]
IN_BROWSER = {"browser": "tests/browser/test_first_hour.py"}
"""The tutorial in the browser, and the test that follows it."""
LANGUAGES = {"python", "console", "toml", "text", "yaml", "matlab", "bibtex", "{toctree}"}


def name(page):
    return str(page.relative_to(ROOT))


@pytest.mark.exhaustive
@pytest.mark.parametrize("page", RUN, ids=name)
def test_code_of_a_page_runs_and_prints_the_shown_output(page, tmp_path, request):
    lab = request.getfixturevalue("lab") if needs_lab(page) else None
    start_page(page, tmp_path, INSTALL | ({LAB: lab.url} if lab else {}))


@pytest.mark.wall_clock
def test_emulated_bench_tutorial_runs_over_a_bus_between_processes(tmp_path):
    # The check waits for the clock, which an emulator in lockstep does not follow.
    with start_emulator(lockstep=False) as emulator:
        bench = write_bench(tmp_path, emulator, lockstep=False)
        start_page(ON_BENCH, tmp_path, {BENCH: str(bench)}, ["console"])
    with start_live_emulator() as emulator:
        bench = write_bench(tmp_path, emulator)
        with run_lab("--bench", str(bench)) as lab:
            start_page(ON_BENCH, tmp_path, {LAB: lab.url}, ["python"])


@pytest.mark.exhaustive
def test_own_actuator_tutorial_installs_it_for_the_lab(tmp_path, monkeypatch):
    start_page(OWN_ACTUATOR, tmp_path, INSTALL, ["console"])
    monkeypatch.setenv("PYTHONPATH", f"{ROOT}{os.pathsep}{tmp_path}")
    with run_lab() as lab:
        start_page(OWN_ACTUATOR, tmp_path, {LAB: lab.url}, ["python"])


def test_each_tutorial_is_executed():
    notebooks = {page.stem for page in TUTORIALS.glob("*.ipynb")}
    pages = {page.stem for page in [*RUN, ON_BENCH, OWN_ACTUATOR] if page.parent == TUTORIALS}
    for test in IN_BROWSER.values():
        assert (ROOT / test).is_file()
    executed = notebooks | pages | {*IN_BROWSER}
    assert executed == {page.stem for page in TUTORIALS.iterdir()} - {"index"}


@pytest.mark.parametrize("guide", GUIDES, ids=name)
def test_block_is_executed_or_states_why_not(guide):
    for block in read_blocks(guide):
        assert block.language in LANGUAGES, f"line {block.line}: {block.language!r}"
        if block.note == "not executed":
            assert len(block.subject) > 10, f"line {block.line}: no reason"


@pytest.mark.parametrize("section", ["tutorials", "howto"])
def test_section_index_lists_each_page(section):
    pages = {page.stem for page in (ROOT / "docs" / section).iterdir()} - {"index"}
    (contents,) = (
        block.text
        for block in read_blocks(ROOT / "docs" / section / "index.md")
        if block.language == "{toctree}"
    )
    assert {line for line in contents.splitlines() if line and line[0] != ":"} == pages

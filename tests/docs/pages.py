"""The code blocks of a page in Markdown, run in their order and in the current folder.

    python -m tests.docs.pages PAGE LANGUAGE,… [WRITTEN=HERE …]

A block ```python is run, a block ```console by bash, without its prompts. A block ```text that
follows Python code is the output of the code: a page that shows the output of one block shows it
for each. The Python blocks of a page share their names. WRITTEN is a text of the page, such as the
address of the lab, and HERE is its replacement. A page is run in a process of its own, since
examples interrupt it and start a cluster.

A comment before a block describes what is special about it:

    <!-- file: NAME -->                the block is the content of this file
    <!-- not executed: REASON -->      the block is not run
"""

import contextlib
import io
import os
import re
import signal
import subprocess
import sys
from collections.abc import Collection, Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

from markdown_it import MarkdownIt

ROOT = Path(__file__).parents[2]
LAB = "http://127.0.0.1:8000"
"""The address of the lab in the pages."""
BENCH = "svsa/hardware/emulator/bench.toml"
"""The bench file in the pages."""

OFFLINE = "python -m pip install --no-deps --no-index --no-build-isolation --target . ."
INSTALL = {"$ pip install .\n": f"$ {OFFLINE}\n"}
"""The installation command of a page, and its offline replacement into the folder of the test."""

COMMENT = re.compile(r"<!-- (file|not executed): (.+?) -->", re.DOTALL)
PROMPT = "$ "
TIMEOUT_S = 400.0
RUN = ("python", "console")


class Block(NamedTuple):
    """A code block. line: first line in the file; note, subject: from the comment before it."""

    language: str
    text: str
    line: int
    note: str
    subject: str

    @property
    def is_run(self) -> bool:
        return self.language in RUN and not self.note


def read_blocks(path: Path) -> Iterator[Block]:
    """Read the code blocks of a page, without the tables of contents."""
    note = subject = ""
    for token in MarkdownIt().parse(path.read_text(encoding="utf-8")):
        if token.type == "html_block" and token.content.startswith("<!--"):
            found = COMMENT.fullmatch(token.content.strip())
            assert found, f"{path}: unknown comment {token.content}"
            note, subject = found[1], " ".join(found[2].split())
        elif token.type == "fence":
            assert token.map is not None
            yield Block(token.info, token.content, token.map[0] + 2, note, subject)
            note = subject = ""


def needs_lab(path: Path) -> bool:
    """Whether an executed block connects to a lab."""
    return any(LAB in block.text for block in read_blocks(path) if block.is_run)


def start_page(
    path: Path, folder: Path, replaced: Mapping[str, str], languages: Collection[str] = RUN
) -> None:
    """Run the blocks of a page in a process of its own; raises `AssertionError` if one fails.

    Args:
        path: The page.
        folder: Where commands run and files are written.
        replaced: Texts of the page and what they are here, such as the address of the lab.
        languages: Of the blocks that are run.
    """
    folders = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    environment = os.environ | {"SVSA_DATA": str(folder / "data"), "PATH": folders}
    # A page may install a package into its folder.
    paths = f"{ROOT}{os.pathsep}{folder}"
    environment |= {"PYTHONPATH": paths, "MPLBACKEND": "agg", "NO_COLOR": "1"}
    texts = [f"{written}={here}" for written, here in replaced.items()]
    done = subprocess.run(
        [sys.executable, "-m", "tests.docs.pages", str(path), ",".join(languages), *texts],
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        timeout=TIMEOUT_S,
    )
    assert done.returncode == 0, done.stderr[-4000:]


def run_page(path: Path, replaced: Mapping[str, str], languages: Collection[str]) -> int:
    """Run the blocks of a page in this process, and return their number."""
    names: dict[str, object] = {"__name__": "__main__"}
    count, printed, unshown = 0, "", ""
    is_shown = False
    for block in read_blocks(path):
        text = block.text
        for written, here in replaced.items():
            text = text.replace(written, here)
        place = f"{path}:{block.line}"
        if block.note == "file":
            Path(block.subject).write_text(text, encoding="utf-8")
        elif block.language == "text" and printed:
            assert printed == block.text, f"{place}: the code before prints\n{printed}"
            is_shown, printed = True, ""
        elif block.is_run and block.language in languages:
            unshown, printed, count = unshown or printed, "", count + 1
            if block.language == "python":
                # Blank lines in front, so that a traceback has the line of the page.
                code = compile("\n" * (block.line - 1) + text, str(path), "exec")
                with contextlib.redirect_stdout(io.StringIO()) as stream:
                    exec(code, names)  # noqa: S102
                printed = stream.getvalue()
            else:
                run_commands(text, place)
    unshown = unshown or printed
    assert not (is_shown and unshown), f"{path} shows the output of some blocks, but not\n{unshown}"
    return count


def run_commands(text: str, place: str) -> None:
    """Run the commands after the prompts; lines without a prompt are the output."""
    lines = [line.removeprefix(PROMPT) for line in text.splitlines() if line.startswith(PROMPT)]
    assert lines, f"{place}: no command after a prompt"
    script = "\n".join(["set -euo pipefail", *lines])
    done = subprocess.run(["bash", "-c", script], capture_output=True, text=True, timeout=TIMEOUT_S)
    assert done.returncode == 0, f"{place}\n{done.stdout}{done.stderr}"


if __name__ == "__main__":
    # A shell starts background processes with interrupts ignored.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    page, languages, *texts = sys.argv[1:]
    replacements = dict(text.split("=", 1) for text in texts)
    assert run_page(Path(page), replacements, languages.split(",")), "the page has no block to run"

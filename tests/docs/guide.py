"""The code blocks of a guide in Markdown, run in their order in a folder of their own.

A comment before a block describes what is special about it:

    <!-- file: NAME -->                the block is the content of this file
    <!-- not executed: REASON -->      the block is not run
"""

import re
import subprocess
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

from markdown_it import MarkdownIt

ROOT = Path(__file__).parents[2]
LAB = "http://127.0.0.1:8000"
"""The address of the lab in the guides."""

COMMENT = re.compile(r"<!-- (file|not executed): (.+?) -->", re.DOTALL)
PROMPT = "$ "
TIMEOUT_S = 300.0


class Block(NamedTuple):
    """A code block. line: its first line in the file; note, subject: of the comment before it."""

    language: str
    text: str
    line: int
    note: str
    subject: str

    @property
    def is_run(self) -> bool:
        return self.language in ("python", "console") and not self.note


def read_blocks(path: Path) -> Iterator[Block]:
    """The code blocks of a page; the tables of contents are none."""
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
    """Whether a block that is run connects to a lab."""
    return any(LAB in block.text for block in read_blocks(path) if block.is_run)


def run_page(path: Path, folder: Path, replaced: Mapping[str, str]) -> int:
    """Run the blocks of a page in a folder, and return how many were run.

    Python blocks share their names; a console block is run by bash, without its prompts.

    Args:
        path: The page.
        folder: Where commands run and files are written.
        replaced: Texts of the page and what they are here, such as the address of the lab.
    """
    names: dict[str, object] = {"__name__": "__main__"}
    count = 0
    for block in read_blocks(path):
        text = block.text
        for written, here in replaced.items():
            text = text.replace(written, here)
        if block.note == "file":
            (folder / block.subject).write_text(text, encoding="utf-8")
        elif block.is_run:
            count += 1
            if block.language == "python":
                # Blank lines in front, so that a traceback has the line of the page.
                exec(compile("\n" * (block.line - 1) + text, str(path), "exec"), names)  # noqa: S102
            else:
                run_commands(text, folder, f"{path}:{block.line}")
    return count


def run_commands(text: str, folder: Path, place: str) -> None:
    """Run what follows the prompts; what has none is the output of the command."""
    lines = [line.removeprefix(PROMPT) for line in text.splitlines() if line.startswith(PROMPT)]
    assert lines, f"{place}: no command after a prompt"
    script = "\n".join(["set -euo pipefail", *lines])
    done = subprocess.run(
        ["bash", "-c", script], cwd=folder, capture_output=True, text=True, timeout=TIMEOUT_S
    )
    assert done.returncode == 0, f"{place}\n{done.stdout}{done.stderr}"

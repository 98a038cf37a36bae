"""Architecture, instructions for extensions and decisions name only identifiers of the source.

An identifier is a word in backticks with an underscore or an inner capital letter, or a name,
dotted or not, that fills its backticks. What the source does not have, such as another program or a
function that was removed, has no backticks. NAME is replaced by the reader.
`test_paths.py` checks the paths.
"""

import re
from functools import cache
from pathlib import Path

import pytest

from tests.package.test_paths import ROOT, SOURCES

DOCUMENTS = [
    *(ROOT / "docs" / name for name in ("architecture.md", "adding.md")),
    *sorted((ROOT / "docs" / "decisions").glob("*.md")),
]
BLOCK = re.compile(r"^( *)```.*?^\1```", re.MULTILINE | re.DOTALL)
CODE = re.compile(r"(?<!`)`([^`]+)`(?!`)")
PATH_OR_OPTION = re.compile(r"\S*/\S*|(?<!\S)-\S+")
FILE = re.compile(r"[\w-]+\.(?:css|json|md|py|sh|toml|tsx?|txt)")
NAME = re.compile(r"[A-Za-z_]\w*(?:\.[A-Za-z_]\w*)*")
WORD = re.compile(r"[A-Za-z_]\w*", re.ASCII)
MARKED = re.compile(r"\w_\w|[a-z][A-Z]")
PROSE = {
    ".py": re.compile(r'"""[\s\S]*?"""|#.*'),
    ".ts": re.compile(r"/\*[\s\S]*?\*/|//.*"),
    ".tsx": re.compile(r"/\*[\s\S]*?\*/|//.*"),
    ".css": re.compile(r"/\*[\s\S]*?\*/"),
    ".toml": re.compile(r"#.*"),
}
"""Docstrings and comments, which may be as old as the documents."""


@cache
def read_source() -> tuple[set[str], set[str]]:
    """Return all words and modules of the code, and the names of all files and those of `docs`."""
    paths = [path for folder in (*SOURCES, "docs") for path in (ROOT / folder).rglob("*")]
    code = [ROOT / "pyproject.toml", *(path for path in paths if path.suffix in PROSE)]
    words = {path.stem for path in code}
    for path in code:
        words.update(WORD.findall(PROSE[path.suffix].sub(" ", path.read_text(encoding="utf-8"))))
    return words, {path.name for path in paths}


def find_unknown(text: str) -> list[str]:
    words, files = read_source()
    unknown = []
    for code in CODE.findall(BLOCK.sub("", text)):
        if FILE.fullmatch(code):
            unknown += [] if code in files else [code]
            continue
        names = WORD.findall(PATH_OR_OPTION.sub(" ", code))
        if not NAME.fullmatch(code):
            names = filter(MARKED.search, names)
        unknown += [name for name in names if name not in words and "NAME" not in name]
    return unknown


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda path: path.name)
def test_identifiers_of_a_document_exist(document: Path) -> None:
    assert find_unknown(document.read_text(encoding="utf-8")) == []


def test_search_finds_what_the_source_does_not_have() -> None:
    absent = "".join(["Absent", "Route"])
    text = (
        f"`compiled` of\n`svsa.simulate`, `{absent}`, `svsa.{absent}`, `f({absent}, a_b_{absent})`"
    )
    assert find_unknown(text) == [absent, absent, absent, f"a_b_{absent}"]
    assert find_unknown(f"`{absent}.py`, `NAMELoad`, `tests/{absent}.py`") == [f"{absent}.py"]

"""Documents, docstrings and comments name only files, folders and modules that exist.

Names are resolved from files and their syntax; nothing of the lab is imported.
"""

import ast
import io
import re
import tokenize
import tomllib
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PACKAGES = {"svsa": ROOT, "svsa_server": ROOT / "backend", "tests": ROOT}
GENERATED = {
    *("backend/svsa_server/page", "frontend/web/src/core/api/schema.d.ts"),
    *("docs/_build", "docs/reference/generated"),
}
REFERENCE = ROOT / "docs/reference/generated"
OTHERS = {
    "svsa.channels",
    "svsa.series",
    "svsa.Sample",
}  # In the console of the page; schema of MCAP.

PATH = re.compile(r"(?<![\w/.~<>-])(?:svsa|backend|tests|frontend|docs)/[\w./*{}…<>-]*")
PLACEHOLDER = re.compile(r"[*{}…<>]|[A-Z]{4}")
LINK = re.compile(r"\]\((?!https?:|mailto:|#)([^)\s]+)\)")
MODULE = re.compile(r"`((?:svsa|svsa_server|tests)(?:\.[A-Za-z_]\w*)+)")
SHORT_PATH = re.compile(r"`((?:[\w-]+/)+(?:[\w-]+\.\w+)?)`")
ENDING = re.compile(r"(?<![\w/.~<>{}…-])(?:[\w-]+/)+[\w-]+\.(?:py|tsx?)\b")
SOURCES = ["svsa", "backend", "frontend/scene", "frontend/web/src", "frontend/web/tests", "tests"]
TEST = re.compile(r"`(test_\w+)`")

DOCUMENTS = [
    ROOT / "README.md",
    ROOT / "CONTRIBUTING.md",
    *sorted(
        path
        for path in (ROOT / "docs").rglob("*.md")
        if not any((ROOT / folder) in path.parents for folder in GENERATED)
    ),
    ROOT / "svsa/README.md",
    ROOT / "frontend/web/README.md",
]


def find_missing_paths(text):
    for path in PATH.findall(text):
        written = path.rstrip("./-")
        if written in GENERATED or PLACEHOLDER.search(path) or (ROOT / written).exists():
            continue
        if not any((ROOT / folder) in (ROOT / written).parents for folder in GENERATED):
            yield written


def find_missing_endings(text):
    """Yield names that end in the path of a source file that does not exist."""
    for path in ENDING.findall(text):
        if not PLACEHOLDER.search(path) and path not in list_endings():
            yield path


@cache
def list_endings():
    paths = [path for folder in SOURCES for path in (ROOT / folder).rglob("*.*")]
    parts = [
        path.relative_to(ROOT).parts for path in paths if path.suffix in {".py", ".ts", ".tsx"}
    ]
    return {"/".join(one[start:]) for one in parts for start in range(len(one))}


def find_missing_modules(text):
    for name in MODULE.findall(text):
        if name not in OTHERS | read_entry_points() and not is_defined(name):
            yield name


@cache
def list_reference_pages():
    """Return the pages that `make docs` writes: `PAGES` of `docs/reference_pages.py`."""
    for node in ast.parse((ROOT / "docs/reference_pages.py").read_text()).body:
        if isinstance(node, ast.AnnAssign) and ast.unparse(node.target) == "PAGES":
            return {REFERENCE / f"{ast.literal_eval(key)}.md" for key in node.value.keys}
    raise AssertionError("docs/reference_pages.py has no table PAGES")


@cache
def read_entry_points():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    return set(project["entry-points"])


@cache
def is_defined(name):
    first, *rest = name.split(".")
    place = PACKAGES[first] / first
    for part in rest:
        if (place / part).is_dir():
            place /= part
        elif (place / f"{part}.py").is_file():
            place /= f"{part}.py"
        elif place.is_dir():
            return part in list_names(place / "__init__.py")
        else:  # An attribute of an attribute is not followed.
            return part in list_names(place)
    return True


@cache
def list_names(path):
    """Return the names that a module binds at its top level or in its table of lazy names."""
    source = path.read_text() if path.is_file() else ""
    names = {"__main__", "__version__"}
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            names.add(node.name)
        elif isinstance(node, ast.alias):
            names.add(node.asname or node.name.split(".")[0])
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            names.add(node.id)
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            names.add(node.value)
    return names


def read_prose(source):
    """Return the docstrings and comments of a module."""
    documented = ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef
    nodes = [node for node in ast.walk(ast.parse(source)) if isinstance(node, documented)]
    docstrings = [ast.get_docstring(node) or "" for node in nodes]
    tokens = tokenize.generate_tokens(io.StringIO(source).readline)
    comments = [token.string for token in tokens if token.type == tokenize.COMMENT]
    return "\n".join([*docstrings, *comments])


def find_missing(text):
    paths = {*find_missing_paths(text), *find_missing_endings(text)}
    return [*sorted(paths), *find_missing_modules(text)]


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda path: str(path.relative_to(ROOT)))
def test_names_in_documents_exist(document):
    text = document.read_text()
    links = {link.split("#")[0] for link in LINK.findall(text)}
    targets = {link: (document.parent / link).resolve() for link in links}
    lost = [
        link
        for link, path in targets.items()
        if path not in list_reference_pages() and (path.parent == REFERENCE or not path.exists())
    ]
    assert find_missing(text) + lost == []


@pytest.mark.parametrize("document", ["svsa/README.md", "frontend/web/README.md"])
def test_short_paths_start_at_the_document_or_in_one_of_its_folders(document):
    path = ROOT / document
    places = [ROOT, path.parent, *(one for one in path.parent.iterdir() if one.is_dir())]
    written = SHORT_PATH.findall(path.read_text())
    lost = [one for one in written if not any((place / one).exists() for place in places)]
    assert lost == []


def test_tests_of_the_equation_table_exist():
    tests = {path.stem for path in (ROOT / "tests").rglob("test_*.py")}
    assert set(TEST.findall((ROOT / "svsa/README.md").read_text())) <= tests


@pytest.mark.parametrize("folder", ["svsa", "backend", "frontend/scene", "tests"])
def test_names_in_docstrings_and_comments_exist(folder):
    missing = {}
    for path in sorted((ROOT / folder).rglob("*.py")):
        source = path.read_text()
        # The syntax is parsed only if some text, perhaps code, names a missing file.
        if path != Path(__file__) and find_missing(source):
            lost = find_missing(read_prose(source))
            if lost:
                missing[str(path.relative_to(ROOT))] = lost
    assert missing == {}

"""Count the lines of the tree, and compare them with the ceilings of decision 29.

python -m tests.package.size          the table of decision 29
python -m tests.package.size --check  fails if a folder has more lines than its ceiling
"""

import ast
import re
import subprocess
import sys
from collections import Counter
from collections.abc import Iterable, Iterator
from pathlib import Path

ROOT = Path(__file__).parents[2]
DECISION = ROOT / "docs/decisions/29-size.md"
SUFFIXES = (".py", ".ts", ".tsx", ".css")
KINDS = ("blank", "docstrings, comments", "imports", "code")
_CEILING = re.compile(r"^\| `([\w./-]+)` \| ([\d,]+) \| (.*?) *\|$", re.MULTILINE)
_COMMENT = re.compile(r"/\*[\s\S]*?\*/|^\s*//.*", re.MULTILINE)
_IMPORT = re.compile(r"^(?:import\b|@import\b|export\b[^;=(]*\bfrom\b)[^;]*;", re.MULTILINE)


def list_ceilings(text: str) -> dict[str, int]:
    """Return the ceiling of each folder in lines: the sum of its rows, each with a reason."""
    ceilings: Counter[str] = Counter()
    for folder, lines, reason in _CEILING.findall(text):
        if not reason:
            raise ValueError(f"{folder}, {lines} lines: state what they are for.")
        ceilings[folder] += int(lines.replace(",", ""))
    return dict(ceilings)


def count_folders(folders: Iterable[str]) -> dict[str, Counter[str]]:
    """Count the lines of the files of git by kind; each file is in its innermost folder.

    Raises:
        ValueError: If a file is in none of the folders.
    """
    listing = ["git", "ls-files", "-z", "--", *(f"*{suffix}" for suffix in SUFFIXES)]
    names = subprocess.run(listing, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    counts = {folder: Counter[str]() for folder in folders}
    for name in filter(None, names.split("\0")):
        parents = [parent.as_posix() for parent in Path(name).parents]
        folder = next((parent for parent in parents if parent in counts), None)
        if folder is None:
            raise ValueError(f"{name}: no folder of {DECISION.name} contains it; add a row.")
        if (ROOT / name).is_file():
            counts[folder] += count_lines((ROOT / name).read_text(encoding="utf-8"), name)
    return counts


def count_lines(source: str, name: str) -> Counter[str]:
    """Count the lines of a file by kind; a line of two kinds is of the earlier one in `KINDS`."""
    lines = source.splitlines()
    find = _find_in_python if name.endswith(".py") else _find_in_page
    kinds = dict.fromkeys(range(1, len(lines) + 1), "code")
    for kind, first, last in find(source):
        kinds |= dict.fromkeys(range(first, last + 1), kind)
    for number, line in enumerate(lines, 1):
        if not line.strip():
            kinds[number] = "blank"
    return Counter(kinds.values())


def _find_in_python(source: str) -> Iterator[tuple[str, int, int]]:
    """Yield kind, first and last line of imports, of texts that are statements, of comments."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import | ast.ImportFrom):
            yield "imports", node.lineno, node.end_lineno or node.lineno
        elif isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            yield "docstrings, comments", node.lineno, node.end_lineno or node.lineno
    for number, line in enumerate(source.splitlines(), 1):
        if line.lstrip().startswith("#"):
            yield "docstrings, comments", number, number


def _find_in_page(source: str) -> Iterator[tuple[str, int, int]]:
    for kind, pattern in (("imports", _IMPORT), ("docstrings, comments", _COMMENT)):
        for match in pattern.finditer(source):
            first = source.count("\n", 0, match.start()) + 1
            yield kind, first, first + match[0].count("\n")


def find_excess(counts: dict[str, Counter[str]], ceilings: dict[str, int]) -> list[str]:
    """Return a message for each folder that has more lines than its ceiling."""
    return [
        f"{folder}: {count.total():,} lines, {count.total() - ceilings[folder]:,} more than its"
        f" ceiling of {ceilings[folder]:,}. Remove lines, or add a row with their number and what"
        f" they are for to {DECISION.relative_to(ROOT)}."
        for folder, count in counts.items()
        if count.total() > ceilings[folder]
    ]


def main() -> None:
    """Print the table, or check the ceilings."""
    ceilings = list_ceilings(DECISION.read_text(encoding="utf-8"))
    counts = count_folders(ceilings)
    if "--check" in sys.argv[1:]:
        sys.exit("\n".join(find_excess(counts, ceilings)) or 0)
    rows = [*counts.items(), ("all", sum(counts.values(), Counter[str]()))]
    table = [f"| folder | lines | {' | '.join(KINDS)} |", f"|{'---|' * (len(KINDS) + 2)}"]
    for folder, count in rows:
        cells = (f"{number:,}" for number in (count.total(), *(count[kind] for kind in KINDS)))
        table.append(f"| {folder} | {' | '.join(cells)} |")
    sys.stdout.write("\n".join(table) + "\n")


if __name__ == "__main__":
    main()

"""The count of the tree's lines, and its ceilings."""

from collections import Counter

import pytest

from tests.package.size import (
    DECISION,
    count_folders,
    count_lines,
    find_excess,
    list_ceilings,
)

PYTHON = '''"""A text
of two lines."""

import a
from b import (
    c,
)

# Why.
x = """code"""  # also code
'''
TYPESCRIPT = """/** Text. */
import { a } from "./a";
import type {
  B,
} from "./b";

// Why.
export const x = 1; // code
"""
TABLE = "| `svsa` | 1,200 | the lab |\n| `svsa` | 30 | a feature |\n| `tests` | 7 | tests |\n"


@pytest.mark.parametrize(
    ("name", "source", "numbers"),
    [("a.py", PYTHON, (2, 3, 4, 1)), ("a.tsx", TYPESCRIPT, (1, 2, 4, 1))],
)
def test_lines_are_counted_by_kind(name, source, numbers):
    kinds = ("blank", "docstrings, comments", "imports", "code")
    assert count_lines(source, name) == dict(zip(kinds, numbers, strict=True))


def test_ceiling_is_the_sum_of_rows_with_a_reason():
    assert list_ceilings(TABLE) == {"svsa": 1230, "tests": 7}
    with pytest.raises(ValueError, match=r"svsa, 5 lines: state what"):
        list_ceilings(TABLE + "| `svsa` | 5 |  |\n")


def test_excess_names_folder_lines_and_remedy():
    ceilings = list_ceilings(TABLE)
    at_most = {"svsa": Counter(code=1000, blank=230), "tests": Counter(code=7)}
    assert find_excess(at_most, ceilings) == []
    (message,) = find_excess(at_most | {"svsa": Counter(code=1231)}, ceilings)
    assert message.startswith("svsa: 1,231 lines, 1 more than its ceiling of 1,230.")
    assert "29-size.md" in message


@pytest.mark.exhaustive
def test_every_file_is_in_a_folder_of_the_decision():
    ceilings = list_ceilings(DECISION.read_text(encoding="utf-8"))
    assert all(count.total() for count in count_folders(ceilings).values())
    with pytest.raises(ValueError, match=r"^backend/\S+: no folder of 29-size.md contains it"):
        count_folders({"svsa"})

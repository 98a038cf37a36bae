"""A journal continues the same search after a kill, and no other one."""

import pytest

from svsa.evaluation.campaign.journal import Journal, define_search

TRIALS = [{"number": number, "cost": 0.1 + number} for number in range(3)]


def test_search_continues_after_its_last_complete_line(tmp_path):
    path = tmp_path / "found.search"
    journal = Journal(path, {"seed": 1})
    assert not path.exists()
    for trial in TRIALS[:2]:
        journal.write(trial)
    path.write_text(path.read_text() + '{"number": 2, "co')
    journal = Journal(path, {"seed": 1})
    assert journal.known == TRIALS[:2]
    journal.write(TRIALS[2])
    journal = Journal(path, {"seed": 1})
    assert journal.known == TRIALS
    assert Journal(path, {"seed": 2}).known == []
    journal.remove()
    assert Journal(path, {"seed": 1}).known == []


@pytest.mark.parametrize("text", ['{"seed": 1, "severities": [1.0]}', "[1\n", "\n\n", "{}\n[1]\n"])
def test_other_files_are_not_continued_but_replaced(tmp_path, text):
    path = tmp_path / "found.search"
    path.write_text(text)
    journal = Journal(path, {"seed": 1})
    assert journal.known == []
    journal.write(1)
    assert Journal(path, {"seed": 1}).known == [1]


def test_search_is_defined_by_the_code_of_its_law():
    codes = {define_search(law, seed=1)["code"] for law in ("ndobc", "fl")}
    assert len(codes) == 2

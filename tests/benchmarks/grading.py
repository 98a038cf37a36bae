"""How many submissions `svsa grade` works off in an hour, laws and recorded runs by turns.

    python -m tests.benchmarks.grading [SUBMISSIONS] [SECONDS]

Every second submission is a law (isolated; with as many trials as its grade needs). The others have
two recorded runs of twelve seconds. They are graded in parallel, as in `svsa grade`, including the
start of its processes. No grading starts after the time is over. Prints the number of submissions
per hour, and how busy the machine was.
"""

import itertools
import os
import sys
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from time import monotonic

from svsa.runs.records.catalogue.runs import Catalogue
from svsa.teaching.course.file import read_course
from svsa.teaching.grading.grade import Grade
from svsa.teaching.grading.gradebook import Book
from svsa.teaching.grading.queue import grade_files
from svsa.teaching.submission import Submission
from tests.teaching.course.runs import find_exercise
from tests.teaching.course.student import find_law
from tests.teaching.grading.submissions import EXERCISE, record_step

SUBMISSIONS = 24
LONGEST_S = 60.0
_RECORDED = ("load", "exact-model")


def write_submissions(folder: Path, count: int) -> list[Path]:
    """Write a submission of each student in a folder, and the runs that they name."""
    catalogue = Catalogue(folder)
    runs = {step: record_step(catalogue, step) for step in _RECORDED}
    law = find_law(find_exercise("own-law"))
    files = []
    for number in range(count):
        place = folder / f"student-{number}"
        place.mkdir()
        student = f"Student {number}"
        submission = Submission(student=student, exercise=EXERCISE, runs=runs)
        if number % 2 == 0:
            submission = Submission(student=student, exercise="own-law", law=law.encode())
        files.append(place / "submission.json")
        submission.write(files[-1])
    return files


def grade_until(folder: Path, files: list[Path], longest_s: float) -> tuple[int, int, float]:
    """Return the numbers of graded laws and of recorded runs, and the duration, s."""
    exercises = {one.name: one for one in read_course()}
    book, begin = Book(folder / "class"), monotonic()
    waiting = iter(files)

    def hand_out() -> Iterator[Path]:
        return itertools.takewhile(lambda _: monotonic() - begin < longest_s, waiting)

    given = [one for _, one in grade_files(hand_out(), exercises, folder, book)]
    names = [one.exercise for one in given if isinstance(one, Grade)]
    laws = names.count("own-law")
    return laws, len(names) - laws, monotonic() - begin


def main(count: int = SUBMISSIONS, longest_s: float = LONGEST_S) -> None:
    with TemporaryDirectory(prefix="svsa-grading-") as name:
        folder = Path(name)
        files = write_submissions(folder, count)
        laws, recorded, took_s = grade_until(folder, files, longest_s)
    load = " ".join(f"{one:.1f}" for one in os.getloadavg())
    rate = 3600 * (laws + recorded) / took_s
    print(f"{laws} laws and {recorded} recorded submissions in {took_s:.1f} s: {rate:.0f} an hour")
    print(f"{os.cpu_count()} cores, load average {load}, svsa grade's processes included")


if __name__ == "__main__":
    given = sys.argv[1:]
    main(*map(int, given[:1]), *map(float, given[1:2]))

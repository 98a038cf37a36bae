"""A grade follows from exact replay and from hidden trials; it is given once."""

import csv
import io
import json

import pytest
from typer.testing import CliRunner

import svsa
from svsa.cli import app
from svsa.errors import StateError
from svsa.evaluation.ranking.scenarios import PUBLIC_SEED
from svsa.evaluation.ranking.test_set import build_test_trial
from svsa.runs.records.catalogue.runs import Catalogue
from svsa.teaching.course.file import parse_exercise
from svsa.teaching.grading import law_points
from svsa.teaching.grading.grade import grade
from svsa.teaching.grading.gradebook import Book
from svsa.teaching.grading.report import write_csv, write_page
from svsa.teaching.isolation import confinement
from svsa.teaching.isolation.probe import check_isolation
from svsa.teaching.isolation.refusal import NotIsolatedError
from svsa.teaching.submission import MAX_LAW_BYTES, Submission, read_submission
from tests.teaching.course.runs import find_exercise
from tests.teaching.grading.submissions import (
    EXERCISE,
    GOOD,
    LAW_EXERCISE,
    LAZY,
    record_step,
    submit_law,
    write_course,
)
from tests.teaching.isolation.test_attacks import isolation  # noqa: F401

pytestmark = pytest.mark.long

OWN_LAW = parse_exercise(LAW_EXERCISE, "own-law")
SECRET = bytes(range(32))


@pytest.fixture(autouse=True)
def few_trials(monkeypatch):
    monkeypatch.setattr(law_points, "BLOCK", 8)
    monkeypatch.setattr(law_points, "MOST_TRIALS", 8)


def run(*arguments):
    words = ["grade", *map(str, arguments)]
    return CliRunner().invoke(app, words, catch_exceptions=False, env={"COLUMNS": "200"})


def submit(law=LAZY, student="Ada"):
    return Submission(student=student, exercise="own-law", law=law)


def test_run_that_replays_has_its_points(tmp_path):
    catalogue = Catalogue(tmp_path)
    runs = {step: record_step(catalogue, step) for step in ("load", "exact-model")}
    given = Submission(student="Ada", exercise=EXERCISE, runs=runs)
    found = grade(given, find_exercise(EXERCISE), tmp_path, SECRET)
    assert found.seed is None
    assert found.points > 0
    assert {one.step for one in found.criteria if one.points} >= {"load"}


def test_run_with_one_changed_bit_is_rejected(tmp_path):
    """The simulation is compared, not the text of the run."""
    catalogue = Catalogue(tmp_path)
    runs = {"load": record_step(catalogue, "load", flip=True)}
    given = Submission(student="Ada", exercise=EXERCISE, runs=runs)
    found = grade(given, find_exercise(EXERCISE), tmp_path, SECRET)
    assert found.points == 0
    reported = [one.feedback for one in found.criteria if one.step == "load"]
    assert reported
    assert all("does not replay" in one and "at tick 7000" in one for one in reported)


def test_law_trials_depend_on_the_secret_and_the_text_of_the_law(monkeypatch):
    """The submission alone does not reveal them; the same law has the same trials for any
    student.
    """
    drawn = []

    def run_trials(law, seed, place, report):
        drawn.append(seed)

    monkeypatch.setattr("svsa.teaching.grading.grade.run_trials", run_trials)
    for one, secret in (
        (submit(), SECRET),
        (submit(), SECRET),
        (submit(), SECRET[::-1]),
        (submit(GOOD), SECRET),
        (submit(student="Bo"), SECRET),
    ):
        grade(one, OWN_LAW, None, secret)
    assert drawn[0] == drawn[1] == drawn[4]
    assert len({*drawn, PUBLIC_SEED}) == 4
    assert build_test_trial("A", drawn[0], 0) != build_test_trial("A", PUBLIC_SEED, 0)


def test_good_law_has_more_points_than_a_passive_one(tmp_path):
    good, lazy = (grade(submit(law), OWN_LAW, tmp_path, SECRET) for law in (GOOD, LAZY))
    assert good.is_isolated
    assert good.max_points == lazy.max_points == 10
    assert good.points > 5 > lazy.points
    assert "of 8 did" in good.criteria[0].feedback


def test_failed_law_gets_the_reason_and_is_not_run_again(tmp_path):
    found = grade(submit(b"def law(*given): return 1 / 0"), OWN_LAW, tmp_path, SECRET)
    assert found.points == 0
    assert "ZeroDivisionError" in found.criteria[0].feedback


def test_missing_law_has_no_points_and_unrequested_law_is_rejected(tmp_path):
    given = Submission(student="Ada", exercise="own-law")
    assert grade(given, OWN_LAW, tmp_path, SECRET).points == 0
    given = Submission(student="Ada", exercise=EXERCISE, law=LAZY)
    with pytest.raises(svsa.ParameterError, match="requires no law"):
        grade(given, find_exercise(EXERCISE), tmp_path, SECRET)


def test_class_gets_no_grade_without_isolation_and_practice_reports_it(tmp_path, monkeypatch):
    check_isolation.cache_clear()
    with monkeypatch.context() as patched:
        patched.setattr(confinement.shutil, "which", lambda name: None)
        with pytest.raises(NotIsolatedError, match="cannot be isolated"):
            grade(submit(), OWN_LAW, tmp_path, SECRET)
        practice = grade(submit(), OWN_LAW, tmp_path, None)
    check_isolation.cache_clear()
    assert not practice.is_isolated
    assert "not isolated" in write_page([practice])
    with pytest.raises(StateError, match="no grade in a class"):
        Book(tmp_path / "class").keep(practice)


def test_path_of_a_law_stays_in_its_folder(tmp_path):
    (tmp_path / "other.py").write_bytes(GOOD)
    path = submit_law(tmp_path / "ada", LAZY, law_file="../other.py")
    with pytest.raises(svsa.ParameterError, match="a file next to the submission"):
        read_submission(path)
    (tmp_path / "ada" / "link.py").symlink_to(tmp_path / "other.py")
    path = submit_law(tmp_path / "ada", LAZY, law_file="link.py")
    with pytest.raises(svsa.ParameterError, match="a file next to the submission"):
        read_submission(path)
    path = submit_law(tmp_path / "ada", b"#" * (MAX_LAW_BYTES + 1))
    with pytest.raises(svsa.ParameterError, match="at most 65536 bytes"):
        read_submission(path)


def test_class_is_graded_once_with_a_page_and_csv(tmp_path):
    """Invalid submissions are rejected by name, and the others have their grades."""
    course, book = write_course(tmp_path / "course"), tmp_path / "class"
    ada = submit_law(tmp_path / "ada", LAZY, "<b>Ada</b>")
    eve = submit_law(tmp_path / "eve", LAZY, "=Eve", exercise="none-such")
    page, table = tmp_path / "grades.html", tmp_path / "grades.csv"
    options = ("--class", book, "--course", course, "--runs", tmp_path, "--page", page,
               "--csv", table)  # fmt: skip
    assert run(ada, *options).exit_code == 0
    answer = run(eve, *options)
    assert answer.exit_code == 1
    assert "none-such" in answer.output
    (kept,) = (book / "grades").iterdir()
    assert (book / "secret").stat().st_mode & 0o077 == 0
    before = kept.read_bytes()
    kept.write_bytes(before.replace(b'"points": ', b'"points": 1e-3, "points": ', 1))
    marked = kept.read_bytes()
    assert run(ada, *options).exit_code == 0
    assert kept.read_bytes() == marked, "graded again"
    (row,) = csv.DictReader(io.StringIO(table.read_text()))
    assert row["student"] == "<b>Ada</b>"
    assert row["seed"] == json.loads(before)["seed"]
    text = page.read_text()
    assert "&lt;b&gt;Ada&lt;/b&gt;" in text
    assert "<b>Ada" not in text
    (grade_again,) = Book(book).list()
    assert write_csv([grade_again.changed(student="=Eve")]).splitlines()[1].startswith("'=Eve,")


def test_class_or_practice_must_be_chosen(tmp_path):
    path = submit_law(tmp_path / "ada", LAZY)
    with pytest.raises(svsa.ParameterError, match="or --practice instead"):
        run(path)
    with pytest.raises(svsa.ParameterError, match="omitted with --practice"):
        run(path, "--class", tmp_path, "--practice")

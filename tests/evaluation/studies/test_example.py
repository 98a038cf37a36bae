"""The study in the package is what `make examples` computes; an own one takes its place."""

import numpy as np
import pyarrow as pa
import pytest

from svsa.evaluation.studies.execution import run_study
from svsa.evaluation.studies.file import read_study
from svsa.evaluation.studies.rows import find_missing, read_rows
from svsa.evaluation.studies.store import (
    EXAMPLE,
    delete_study,
    keep_study,
    list_studies,
    open_study,
    read_owner,
)
from svsa.evaluation.studies.stored import StudyError
from svsa.evaluation.studies.work import DRAW, run_trials

RECOMPUTED = 8


def expect_same(one: pa.Table, other: pa.Table) -> None:
    assert one.schema.names == other.schema.names
    for name in one.schema.names:
        np.testing.assert_array_equal(one[name].to_numpy(), other[name].to_numpy(), name)


@pytest.mark.exhaustive
def test_example_is_the_built_in_study_and_its_first_rows_are_reproduced_bit_for_bit():
    example = open_study(EXAMPLE)
    assert example.study == read_study("load", runs=256)[1]
    assert find_missing(example) == []
    rows = read_rows(example)
    first = rows.filter(pa.array(rows[DRAW].to_numpy() < RECOMPUTED))
    expect_same(first, run_trials(example.study, 0, RECOMPUTED))


@pytest.mark.exhaustive
def test_every_row_is_computed_to_the_bit():
    example = open_study(EXAMPLE)
    expect_same(read_rows(example), run_trials(example.study, 0, example.study.runs))


def test_example_study_cannot_be_deleted(monkeypatch, tmp_path):
    monkeypatch.setenv("SVSA_DATA", str(tmp_path))
    with pytest.raises(StudyError, match="part of the package"):
        delete_study(open_study(EXAMPLE))
    assert open_study(EXAMPLE).is_example
    assert read_owner(EXAMPLE) == ""
    assert list_studies() == []


@pytest.mark.exhaustive
def test_user_study_replaces_the_example_of_the_same_name(monkeypatch, tmp_path):
    monkeypatch.setenv("SVSA_DATA", str(tmp_path))
    own = keep_study(EXAMPLE, read_study("load", runs=2)[1], owner="ada")
    assert run_study(own, workers=0)
    found = open_study(EXAMPLE)
    assert (found.is_example, found.study.runs, read_owner(EXAMPLE)) == (False, 2, "ada")
    delete_study(found)
    assert open_study(EXAMPLE).is_example

"""Studies from Python: `svsa.run_study`."""

import pytest

import svsa
from svsa.errors import ParameterError
from svsa.evaluation.studies.file import read_study

pytestmark = pytest.mark.long


def test_study_is_run_and_continued_and_returns_a_row_for_each_run(tmp_path, monkeypatch):
    monkeypatch.setenv("SVSA_DATA", str(tmp_path))
    name, study = read_study("perturbation", runs=4)
    rows = svsa.run_study(study, name="mine", workers=0)
    assert len(rows) == study.row_count
    assert set(rows["law"]) == set(study.laws)
    more = svsa.run_study(study, name="mine", runs=6, workers=0)
    assert len(more) == 6 * len(study.laws)
    assert rows.equals(more.iloc[: len(rows)])
    assert name == "perturbation"


def test_study_without_a_name_is_rejected(tmp_path, monkeypatch):
    monkeypatch.setenv("SVSA_DATA", str(tmp_path))
    with pytest.raises(ParameterError, match="name"):
        svsa.run_study(read_study("perturbation", runs=4)[1])

"""A study is deleted for good, also one that is being run."""

from collections.abc import Iterator

import httpx
import pytest

from svsa.client.connection import Connection
from svsa.client.runs import RemoteStudies
from svsa.evaluation.studies.file import read_study
from svsa.evaluation.studies.store import claim_study, find_studies_folder, keep_study, list_studies
from tests.lab_in_process import run_lab_in_process

STUDIES = "/api/v1/studies"


@pytest.fixture(scope="module")
def lab() -> Iterator[httpx.Client]:
    with run_lab_in_process() as lab:
        yield lab.client


def delete(lab: httpx.Client, name: str) -> None:
    """Until it is gone: its rows may take a slow machine longer than one call waits for them."""
    while (answer := lab.delete(f"{STUDIES}/{name}")).status_code == 409:
        assert "delete it later" in answer.json()["detail"]
    assert answer.status_code == 204


def test_one_that_is_being_run_is_cancelled_first_and_leaves_nothing(lab: httpx.Client) -> None:
    begun = lab.post(STUDIES, json={"source": "load", "runs": 20_000, "laws": ["fl"]})
    name, job = begun.json()["name"], begun.json()["job"]["id"]
    delete(lab, name)
    assert lab.get(f"/api/v1/jobs/{job}").json()["status"] == "cancelled"
    assert lab.get(f"{STUDIES}/{name}").status_code == 404
    assert lab.get(STUDIES).json()["saved"] == []
    assert list(find_studies_folder().iterdir()) == []
    assert lab.delete(f"{STUDIES}/{name}").status_code == 404
    again = lab.post(STUDIES, json={"source": "load", "runs": 1, "laws": ["fl"]}).json()
    assert (again["name"], again["done"]) == (name, 0)
    delete(lab, name)


def test_what_another_process_works_at_is_left_alone(lab: httpx.Client) -> None:
    stored = keep_study("theirs", read_study("load")[1].changed(runs=4))
    with claim_study(stored):
        refused = lab.delete(f"{STUDIES}/theirs")
    assert refused.status_code == 409
    assert "run by another process" in refused.json()["detail"]
    assert [one.name for one in list_studies()] == ["theirs"]


def test_a_script_lists_reads_and_deletes_them(lab: httpx.Client) -> None:
    keep_study("mine", read_study("load")[1].changed(runs=4))
    with Connection("http://lab") as connection:
        connection._http = httpx.Client(
            transport=lab._transport, base_url=f"{lab.base_url}/api/v1", trust_env=False
        )
        studies = RemoteStudies(connection)
        assert "mine" in studies
        assert studies.read("mine")["rows"] > 0
        studies.delete("mine")
        assert "mine" not in studies

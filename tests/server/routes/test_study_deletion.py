"""A study is deleted permanently, also during its run."""

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
    """Delete until it is gone: a slow machine may need longer than the timeout of one call."""
    while (answer := lab.delete(f"{STUDIES}/{name}")).status_code == 409:
        assert "delete it later" in answer.json()["detail"]
    assert answer.status_code == 204


def test_running_study_is_cancelled_first_and_leaves_nothing(lab: httpx.Client) -> None:
    begun = lab.post(STUDIES, json={"source": "load", "runs": 20_000, "laws": ["fl"]})
    name, job = begun.json()["name"], begun.json()["job"]["id"]
    delete(lab, name)
    assert lab.get(f"/api/v1/jobs/{job}").json()["status"] == "cancelled"
    assert lab.get(f"{STUDIES}/{name}").status_code == 404
    assert [one["is_example"] for one in lab.get(STUDIES).json()["saved"]] == [True]
    assert list(find_studies_folder().iterdir()) == []
    assert lab.delete(f"{STUDIES}/{name}").status_code == 404
    again = lab.post(STUDIES, json={"source": "load", "runs": 1, "laws": ["fl"]}).json()
    assert (again["name"], again["done"]) == (name, 0)
    delete(lab, name)


def test_example_study_is_readable_and_cannot_be_deleted(lab: httpx.Client) -> None:
    (example,) = lab.get(STUDIES).json()["saved"]
    address = f"{STUDIES}/{example['name']}"
    assert lab.get(address).json() == example
    assert example["done"] == example["rows"] > 0
    laws = lab.get(f"{address}/summary").raise_for_status().json()["laws"]
    assert [one["law"] for one in laws] == example["laws"]
    assert lab.get(f"{address}/rows?column=law").is_success
    refused = lab.delete(address)
    assert refused.status_code == 409
    assert "part of the package" in refused.json()["detail"]


def test_study_run_by_another_process_is_not_deleted(lab: httpx.Client) -> None:
    stored = keep_study("theirs", read_study("load")[1].changed(runs=4))
    with claim_study(stored):
        refused = lab.delete(f"{STUDIES}/theirs")
    assert refused.status_code == 409
    assert "run by another process" in refused.json()["detail"]
    assert [one.name for one in list_studies()] == ["theirs"]


def test_script_lists_reads_and_deletes_studies(lab: httpx.Client) -> None:
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

"""The documentation site at /docs/guide/."""

from pathlib import Path

import pytest

from svsa_server import page
from tests.lab_in_process import run_lab_in_process


@pytest.fixture
def guide(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(page, "GUIDE", tmp_path / "guide")
    return tmp_path / "guide"


def test_built_guide_is_served_with_a_policy_that_loads_nothing_from_elsewhere(guide: Path):
    (guide / "howto").mkdir(parents=True)
    (guide / "index.html").write_text("<h1>SVSA Lab</h1>")
    (guide / "howto/add_friction.html").write_text("<h1>Add friction</h1>")
    with run_lab_in_process() as lab:
        start = lab.client.get("/docs/guide/")
        deeper = lab.client.get("/docs/guide/howto/add_friction.html")
        missing = lab.client.get("/docs/guide/nothing.html")
        outside = lab.client.get("/docs/guide/..%2f..%2fetc/passwd")
    assert "SVSA Lab" in start.text
    assert "Add friction" in deeper.text
    for answer in (start, deeper):
        assert answer.headers["content-security-policy"].startswith("default-src 'self';")
    assert (missing.status_code, outside.status_code) == (404, 404)


def test_lab_without_the_guide_says_how_to_get_it(guide: Path):
    with run_lab_in_process() as lab:
        answers = [lab.client.get(f"/docs/guide/{page}") for page in ("", "howto/", "index.html")]
    assert [answer.status_code for answer in answers] == [200, 404, 404]
    for answer in answers:
        assert answer.headers["content-type"].startswith("text/html")
        assert "make docs" in answer.text
        assert "href" not in answer.text, "no link without a target"

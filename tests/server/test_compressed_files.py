"""Compressed answers: files of the page, and JSON of the API."""

import gzip
from pathlib import Path

import pytest

from svsa_server.compressed_files import list_accepted_encodings
from svsa_server.page import PAGE
from tests.lab_in_process import run_lab_in_process

TEXT_FILES = sorted(
    path
    for path in (PAGE / "index.html", *(PAGE / "assets").iterdir())
    if path.suffix in (".js", ".css")
)


@pytest.mark.parametrize(
    ("header", "accepted"),
    [
        ("", {""}),
        ("gzip, deflate, br", {"gzip", "deflate", "br"}),
        ("br;q=1.0, GZIP; q=0.5, identity;q=0", {"br", "gzip"}),
        ("gzip;q=0, br;q=0.000", set()),
    ],
)
def test_excluded_encoding_is_not_accepted(header: str, accepted: set[str]) -> None:
    assert list_accepted_encodings(header) == accepted


def test_each_file_of_the_page_comes_in_the_best_accepted_encoding() -> None:
    assert TEXT_FILES
    with run_lab_in_process() as lab:
        for path in TEXT_FILES:
            address = f"/assets/{path.name}"
            answers = {
                encoding: lab.client.get(address, headers={"Accept-Encoding": encoding})
                for encoding in ("identity", "gzip", "br", "br;q=0, gzip;q=0")
            }
            plain = answers["identity"]
            assert plain.content == path.read_bytes()
            assert plain.headers.keys().isdisjoint({"content-encoding"})
            assert answers["br;q=0, gzip;q=0"].headers["etag"] == plain.headers["etag"]
            for encoding, suffix in (("gzip", ".gz"), ("br", ".br")):
                headers = answers[encoding].headers
                assert headers["content-encoding"] == encoding
                assert int(headers["content-length"]) == Path(f"{path}{suffix}").stat().st_size
                assert headers["content-type"] == plain.headers["content-type"]
                assert headers["etag"] != plain.headers["etag"]
                again = {"Accept-Encoding": encoding, "If-None-Match": headers["etag"]}
                assert lab.client.get(address, headers=again).status_code == 304
            assert answers["gzip"].content == plain.content
            for answer in answers.values():
                assert answer.headers["vary"] == "Accept-Encoding"
                assert "immutable" in answer.headers["cache-control"]


def test_start_page_is_checked_again_by_its_entity_tag() -> None:
    with run_lab_in_process() as lab:
        first = lab.client.get("/")
        again = lab.client.get("/", headers={"If-None-Match": first.headers["etag"]})
    assert first.headers["cache-control"] == "no-cache"
    assert again.status_code == 304


def test_json_is_compressed_for_a_client_that_accepts_it() -> None:
    with run_lab_in_process() as lab:
        packed = lab.client.get("/api/v1/kinds", headers={"Accept-Encoding": "gzip"})
        plain = lab.client.get("/api/v1/kinds", headers={"Accept-Encoding": "identity"})
        small = lab.client.get("/api/v1/health", headers={"Accept-Encoding": "gzip"})
        missing = lab.client.get("/api/v1/nothing", headers={"Accept-Encoding": "gzip"})
    assert packed.headers["content-encoding"] == "gzip"
    assert packed.headers["vary"] == plain.headers["vary"] == "Accept-Encoding"
    assert "content-encoding" not in plain.headers
    assert packed.json() == plain.json()
    assert int(packed.headers["content-length"]) < len(gzip.compress(plain.content)) * 1.1
    assert "content-encoding" not in small.headers
    assert missing.status_code == 404

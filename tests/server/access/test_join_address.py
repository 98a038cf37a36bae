"""The join address of a class is reachable from other machines."""

import pytest
from starlette.datastructures import URL

from svsa_server.routes.access import classroom


@pytest.mark.parametrize(
    ("seen", "host", "outward", "reported"),
    [
        ("http://lab.example:8000/", "0.0.0.0", "10.0.0.7", "http://lab.example:8000/"),
        ("http://127.0.0.1:8000/", "0.0.0.0", "10.0.0.7", "http://10.0.0.7:8000/"),
        ("http://localhost:8000/", "10.0.0.8", "10.0.0.7", "http://10.0.0.8:8000/"),
        ("http://127.0.0.1:8000/", "0.0.0.0", None, "http://127.0.0.1:8000/"),
        ("http://127.0.0.1:8000/", "127.0.0.1", "10.0.0.7", "http://127.0.0.1:8000/"),
    ],
)
def test_loopback_name_is_replaced(monkeypatch, seen, host, outward, reported):
    monkeypatch.setattr(classroom, "find_outward_address", lambda: outward)
    assert classroom.choose_join_address(URL(seen), host) == reported

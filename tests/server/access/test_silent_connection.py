"""A connection on which nothing has been asked for a while."""

import time
from http.client import HTTPConnection

from tests.lab import Lab

HTTPX_S = 5.0
"""So long httpx uses one again: a server that closes it just then answers nothing."""


def test_it_is_kept_longer_than_a_client_uses_it_again(lab: Lab) -> None:
    connection = HTTPConnection(lab.url.removeprefix("http://"), timeout=60)
    connection.request("GET", "/api/v1/sessions")
    first = connection.getresponse()
    first.read()
    kept = connection.sock
    time.sleep(HTTPX_S + 1.0)
    connection.request("GET", "/api/v1/sessions")
    assert connection.getresponse().status == first.status == 200
    assert connection.sock is kept
    connection.close()

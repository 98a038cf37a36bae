"""An idle connection."""

import time
from http.client import HTTPConnection

from tests.lab import Lab

HTTPX_S = 5.0
"""For this time httpx reuses one: a server that closes it at that moment gives no answer."""


def test_idle_connection_is_kept_longer_than_clients_reuse_it(lab: Lab) -> None:
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

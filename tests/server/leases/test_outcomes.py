"""A request whose answer is lost: whether it was carried out can be asked."""

import socket
import time
from urllib.parse import urlsplit

import pytest

from svsa_server.leases.outcomes import MAX_KEPT, Outcomes
from tests.lab import Lab


def read_outcome(lab: Lab, name: str) -> dict:
    """Once it is no longer being worked on."""
    for _ in range(100):
        found = lab.client.get(f"/api/v1/requests/{name}").raise_for_status().json()
        if found["outcome"] != "pending":
            return found
        time.sleep(0.05)
    return found


def test_a_request_whose_client_left_is_told_as_carried_out(lab: Lab) -> None:
    """As when the connection breaks after Run: the session runs, and the page must know."""
    lab.client.post(lab.session + "/pause").raise_for_status()
    address = urlsplit(lab.url)
    with socket.create_connection((address.hostname, address.port)) as connection:
        connection.sendall(
            f"POST {lab.session}/start HTTP/1.1\r\nHost: {address.netloc}\r\n"
            "SVSA-Request: left-early\r\nContent-Length: 0\r\n\r\n".encode()
        )
        connection.shutdown(socket.SHUT_RDWR)
    found = read_outcome(lab, "left-early")
    while found["outcome"] == "unknown":
        found = read_outcome(lab, "left-early")
    assert (found["outcome"], found["status"]) == ("carried_out", 200)
    assert lab.read()["status"] == "running"


@pytest.mark.parametrize(
    ("method", "path", "body", "status"),
    [("PUT", "law", {"law": "no_law"}, 422), ("DELETE", "loads/999", None, 404)],
)
def test_a_refused_request_is_told_as_refused(
    lab: Lab, method: str, path: str, body: dict | None, status: int
) -> None:
    name = f"refused-{status}"
    lab.client.request(method, f"{lab.session}/{path}", json=body, headers={"SVSA-Request": name})
    found = read_outcome(lab, name)
    assert (found["outcome"], found["status"]) == ("refused", status)


def test_what_never_came_and_what_only_reads_are_unknown(lab: Lab) -> None:
    lab.client.get(lab.session, headers={"SVSA-Request": "reads"})
    for name in ("never-sent", "reads"):
        found = read_outcome(lab, name)
        assert (found["outcome"], found["status"]) == ("unknown", None)
        assert found["age_s"] > 0


def test_only_the_last_requests_are_kept() -> None:
    outcomes = Outcomes()
    for number in range(MAX_KEPT + 1):
        outcomes.note("p-1", str(number), 200)
    assert outcomes.find("p-1", "0") == ("unknown", None)
    assert outcomes.find("p-1", "1") == ("carried_out", 200)
    outcomes.note("p-1", "1", None)
    assert outcomes.find("p-1", "1") == ("pending", None)
    outcomes.note("p-1", "1", 500)
    assert outcomes.find("p-1", "1") == ("refused", 500)

"""The 3D view of a private session in a class: only its owner and the instructor connect to it."""

from pathlib import Path

import httpx
import pytest
from websockets import InvalidStatus, Subprotocol
from websockets.sync.client import connect

from svsa_server.access.class_keys import ClassKeys
from tests.lab import Lab, run_lab
from tests.server.scene.viewed_lab import SUBPROTOCOL, decode_scene
from tests.waiting import PATIENCE_S


def open_view(
    lab: Lab, session: str, token: str = "", protocol: str = SUBPROTOCOL, origin: str | None = None
) -> list[dict]:
    """Connect as viser's client does: the first messages of the scene."""
    address = f"{lab.url.replace('http', 'ws', 1)}/viser/{session}/"
    headers = {"Authorization": f"Bearer {token}"} if token else {}
    with connect(
        address,
        subprotocols=[Subprotocol(protocol)],
        origin=origin,
        additional_headers=headers,
        compression=None,
        proxy=None,
        max_size=None,
        open_timeout=PATIENCE_S,
        close_timeout=0.1,  # this client reads one message only, so it does not see the end
    ) as view:
        message = view.recv(timeout=PATIENCE_S)
        assert isinstance(message, bytes)
        return decode_scene(message)


def join(lab: Lab, name: str, code: str, role: str) -> str:
    """Join the class; the token of a script of this person."""
    with httpx.Client(base_url=lab.url, timeout=PATIENCE_S, trust_env=False) as browser:
        body = {"name": name, "code": code, "role": role}
        browser.post("/api/v1/join", json=body).raise_for_status()
        return browser.post("/api/v1/tokens", json={}).raise_for_status().json()["token"]


def test_view_of_a_private_session_opens_for_its_owner_and_the_instructor(tmp_path: Path) -> None:
    _, reported = ClassKeys.open(tmp_path)
    assert reported is not None
    with run_lab(data=str(tmp_path), classroom="1") as lab:
        ada = join(lab, "Ada", reported.code, "operator")
        others = [
            join(lab, "Bob", reported.code, "operator"),
            join(lab, "Ola", reported.code, "observer"),
        ]
        created = lab.client.post(
            "/api/v1/sessions", json={}, headers={"Authorization": f"Bearer {ada}"}
        )
        private = created.raise_for_status().json()["session"]
        for token in (ada, reported.instructor_token):
            assert open_view(lab, private, token)
        for token in others:
            assert open_view(lab, "lab", token), "all see the shared session"
            for session in (private, "absent"):
                with pytest.raises(InvalidStatus) as refused:
                    open_view(lab, session, token)
                assert refused.value.response.status_code == 403
        for arguments, status in (
            ({"token": ""}, 401),
            ({"token": ada, "protocol": "other"}, 403),
            ({"token": ada, "origin": "http://elsewhere.example"}, 403),
        ):
            with pytest.raises(InvalidStatus) as refused:
                open_view(lab, private, **arguments)
            assert refused.value.response.status_code == status

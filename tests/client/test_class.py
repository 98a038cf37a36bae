"""Scripts in a class: they log in by a token, and request the control lease like a user."""

import threading
from collections.abc import Iterator
from pathlib import Path

import httpx
import pytest

import svsa
from svsa.client import AccessError, ControlError
from svsa_server.access.class_keys import ClassKeys
from svsa_server.access.memberships import FILE, Membership, Memberships
from svsa_server.access.roles import INSTRUCTOR, Person, Role
from tests.client.copied_script import (
    END_S,
    do_experiment,
    finish_script,
    start_script,
    write_copied_script,
)
from tests.lab import run_lab

pytestmark = pytest.mark.exhaustive
"""`tests/server/access` checks over REST what each token permits."""

ADA, BOB = Person("p-1", "Ada", Role.OPERATOR), Person("p-2", "Bob", Role.OPERATOR)


@pytest.fixture(scope="module")
def tokens(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[str, str, str, str]]:
    """The address of a class, and the tokens of two students and of the instructor."""
    folder: Path = tmp_path_factory.mktemp("class")
    keys, _ = ClassKeys.open(folder)
    for person in (ADA, BOB):
        Memberships(folder / FILE).keep(Membership(person))
    with run_lab("--class", data=str(folder)) as lab:
        yield lab.url, keys.sign(ADA), keys.sign(BOB), keys.sign(INSTRUCTOR)


def test_script_without_token_gets_login_instructions(
    tokens: tuple[str, str, str, str],
) -> None:
    with pytest.raises(AccessError, match="join it with your name and the class code"):
        svsa.connect(tokens[0])


def test_script_waits_for_the_control_lease_until_its_timeout(
    tokens: tuple[str, str, str, str],
) -> None:
    url, ada_s, bob_s, _ = tokens
    with svsa.connect(url, ada_s) as ada, svsa.connect(url, bob_s) as bob:
        with pytest.raises(ControlError, match="No user is in control of session lab"):
            ada.session.law = "fl"
        ada.session.take_control()
        ada.session.law = "fl"
        with pytest.raises(ControlError, match="Ada is in control of session lab: place 1"):
            bob.session.take_control(wait_s=0.0)
        assert ada.session.waiting == ()
        taking = threading.Thread(target=bob.session.take_control)
        taking.start()
        while not ada.session.waiting:
            pass
        with pytest.raises(svsa.ParameterError, match="Bob"):
            ada.session.hand_control_over("Eve")
        ada.session.hand_control_over("Bob")
        taking.join()
        bob.session.law = "ndobc"
        with pytest.raises(ControlError, match="Bob is in control"):
            ada.session.law = "fl"
        bob.session.give_control_back()


def test_script_has_its_own_sessions_streams_and_runs(
    tokens: tuple[str, str, str, str],
) -> None:
    url, ada_s, bob_s, _ = tokens
    with svsa.connect(url, ada_s) as ada, svsa.connect(url, bob_s) as bob:
        result = ada.run("4a", duration_s=0.2, name="mine")
        assert result.name == "mine"
        assert len(list(ada.runs)) == 1
        assert list(bob.runs) == []
        ada.session.take_control()
        ada.session.start()  # In any earlier state: a session at rest has no samples to stream.
        assert len(next(iter(ada.session.stream(duration_s=0.1))).ticks)
        ada.session.give_control_back()


def test_token_is_in_no_address(tokens: tuple[str, str, str, str]) -> None:
    url, ada_s, *_ = tokens
    refused = httpx.get(f"{url}/api/v1/sessions?token={ada_s}", trust_env=False)
    assert refused.status_code == 401


def test_script_of_a_removed_student_is_notified(
    tokens: tuple[str, str, str, str],
) -> None:
    url, ada_s, _, instructor_s = tokens
    person = f"{url}/api/v1/class/people/{ADA.id}"
    headers = {"Authorization": f"Bearer {instructor_s}"}
    with svsa.connect(url, ada_s) as ada:
        stream = iter(ada.session.stream(duration_s=1e6))
        next(stream)
        httpx.patch(
            person, json={"removed": True}, headers=headers, trust_env=False
        ).raise_for_status()
        with pytest.raises(AccessError, match="The instructor has removed you from the class"):
            for _ in stream:
                pass
        with pytest.raises(AccessError, match="has removed you"):
            ada.session.law = "fl"
        httpx.patch(
            person, json={"removed": False}, headers=headers, trust_env=False
        ).raise_for_status()
        assert ada.session.law


def test_copied_script_requests_the_control_lease(
    tokens: tuple[str, str, str, str], tmp_path: Path
) -> None:
    url, ada_s, bob_s, _ = tokens
    headers = {"Authorization": f"Bearer {ada_s}"}
    with httpx.Client(base_url=url, headers=headers, trust_env=False, timeout=60) as client:
        path = write_copied_script(do_experiment(client), url, tmp_path)
    with svsa.connect(url, bob_s) as bob:
        bob.session.take_control()
        script = start_script(path, ada_s, "--shared")
        while bob.session.waiting != ("Ada",):
            assert script.poll() is None, script.communicate()
        bob.session.law = "fl"
        bob.session.give_control_back()
        assert finish_script(script, ("FL",)) == END_S
        state = bob.session.read_state()
        assert (state["control"]["holder"], state["status"]) == (None, "paused")
        assert (state["tick"], state["configuration"]["law"]) == (1500, "fl")
        private = start_script(path, ada_s)
        assert finish_script(private, ("FL",)) == END_S
        assert bob.session.read_state() == state, "it disturbs no user"

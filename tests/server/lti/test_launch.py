"""Launches from a learning platform: the resulting users and roles, and rejections."""

import re
from html import unescape

import pytest

from svsa_server.lti.links import Links
from tests.lab_in_process import run_lab_in_process
from tests.server.lti.platform import (
    CLAIM,
    CLIENT,
    INSTRUCTOR,
    ISSUER,
    make_key,
    read_audit,
    read_query,
    run_platform,
)
from tests.waiting import wait_until


@pytest.fixture(scope="module")
def platform():
    with run_platform() as platform:
        yield platform


@pytest.fixture(scope="module")
def data(tmp_path_factory):
    return tmp_path_factory.mktemp("data")


@pytest.fixture(scope="module")
def lab(platform, data):
    path = platform.write_settings(data)
    with run_lab_in_process(data=str(data), classroom="true", lti=str(path)) as lab:
        yield lab


class Launcher:
    """The browser of a user whom the platform launches."""

    def __init__(self, lab, platform) -> None:
        self.client, self.platform = lab.client, platform
        self.client.cookies.clear()

    def begin(self, **changes):
        asked = {"iss": ISSUER, "client_id": CLIENT, "login_hint": "7", "lti_message_hint": "r"}
        answer = self.client.get("/lti/login", params=asked | changes, follow_redirects=False)
        # httpx sends a Secure cookie over https only; a browser sends it also to this machine.
        self.cookie = answer.headers.get("set-cookie", "").partition(";")[0]
        return answer

    def post(self, token, state):
        headers = {"Origin": "https://moodle.example.org", "Cookie": self.cookie}
        return self.client.post(
            "/lti/launch",
            data={"id_token": token, "state": state},
            headers=headers,
            follow_redirects=False,
        )

    def launch(self, key=None, **changes):
        asked = read_query(self.begin().headers["location"])
        claims = self.platform.build_claims(asked["nonce"], **changes)
        return self.post(self.platform.sign(claims, key), asked["state"])

    def read_access(self):
        return self.client.get("/api/v1/access").json()


@pytest.fixture
def launcher(lab, platform):
    return Launcher(lab, platform)


def test_login_redirects_to_the_platform_with_a_state_of_this_browser(launcher, platform):
    answer = launcher.begin()
    asked = read_query(answer.headers["location"])
    assert answer.status_code == 302
    assert answer.headers["location"].startswith(f"{platform.url}/auth?")
    assert asked["client_id"] == CLIENT
    assert asked["redirect_uri"] == "http://127.0.0.1/lti/launch"
    assert (asked["response_mode"], asked["prompt"]) == ("form_post", "none")
    assert (asked["login_hint"], asked["lti_message_hint"]) == ("7", "r")
    cookie = answer.headers["set-cookie"].lower()
    assert asked["state"] in launcher.cookie
    assert all(word in cookie for word in ("secure", "httponly", "samesite=none", "path=/lti"))


def test_frame_gets_a_link_to_a_window_instead_of_a_login(launcher):
    asked = {"iss": ISSUER, "client_id": CLIENT, "login_hint": '7"><script>'}
    framed = {"Sec-Fetch-Dest": "iframe"}
    answer = launcher.client.get("/lti/login", params=asked, headers=framed)
    assert answer.status_code == 200
    assert "set-cookie" not in answer.headers
    assert "<script" not in answer.text
    link = unescape(re.search(r'href="([^"]*)" target="_blank"', answer.text)[1])
    assert read_query(link) == asked
    assert "script" not in answer.headers["content-security-policy"]
    refused = launcher.client.get("/lti/login", params=asked | {"iss": "x"}, headers=framed)
    assert refused.status_code == 401
    absent = launcher.client.get("/lti/login", params={"iss": ISSUER}, headers=framed)
    assert "user of the login" in absent.text


def test_learner_is_the_same_student_at_the_exercise_each_time(launcher, data):
    answer = launcher.launch()
    assert answer.status_code == 303
    assert answer.headers["location"] == "http://127.0.0.1/learn/own-law"
    first = launcher.read_access()
    assert (first["name"], first["role"]) == ("Ada", "operator")
    (link,) = [one for one in Links(data).list() if one.person == first["id"]]
    assert (link.exercise, link.user) == ("own-law", "user-42")

    launcher.client.cookies.clear()
    launcher.launch()
    assert launcher.read_access()["id"] == first["id"]
    launcher.client.cookies.clear()
    launcher.launch(sub="user-43", name="Bo")
    assert launcher.read_access()["id"] != first["id"]
    noted = wait_until(
        lambda: [one for one in read_audit(data, "lti launch") if one["name"] == "Ada"]
    )
    assert {one["person"] for one in noted} == {first["id"]}


def test_instructor_is_a_student_by_default(launcher):
    launcher.launch(sub="prof", name="Prof", **{f"{CLAIM}roles": [INSTRUCTOR]})
    assert launcher.read_access()["role"] == "operator"


def test_instructor_role_is_enabled_by_the_file(platform, tmp_path):
    path = platform.write_settings(tmp_path, takes_instructors=True)
    with run_lab_in_process(data=str(tmp_path), classroom="true", lti=str(path)) as lab:
        launcher = Launcher(lab, platform)
        launcher.launch(sub="prof", name="Prof", **{f"{CLAIM}roles": [INSTRUCTOR]})
        assert launcher.read_access()["role"] == "instructor"
        launcher.client.cookies.clear()
        launcher.launch()
        assert launcher.read_access()["role"] == "operator"


@pytest.mark.parametrize(
    ("changes", "reported"),
    [
        ({"aud": "another-tool"}, "aud"),
        ({"aud": [CLIENT, "another-tool"], "azp": "another-tool"}, "azp"),
        ({"iss": "https://evil.example.org"}, "iss"),
        ({"nonce": "one-of-before"}, "nonce"),
        ({"exp": 1_000_000_000}, "expired"),
        ({"exp": None}, "exp"),
        ({f"{CLAIM}deployment_id": "99"}, "deployment_id"),
        ({f"{CLAIM}message_type": "LtiDeepLinkingRequest"}, "message_type"),
        ({f"{CLAIM}version": "1.1"}, "version"),
        ({"sub": None}, "id of the user"),
        ({f"{CLAIM}target_link_uri": "http://127.0.0.1/learn/no-such-one"}, "no exercise"),
    ],
)
def test_invalid_launch_is_rejected(launcher, changes, reported):
    answer = launcher.launch(**changes)
    assert answer.status_code == 401
    assert reported in answer.text
    assert launcher.read_access()["inside"] is False


def test_other_signature_is_rejected(launcher, platform):
    forged = make_key("platform-1")
    assert launcher.launch(key=forged).status_code == 401
    unknown = make_key("missing's")
    assert launcher.launch(key=unknown).status_code == 401
    asked = read_query(launcher.begin().headers["location"])
    header, body, _ = platform.sign(platform.build_claims(asked["nonce"])).split(".")
    assert launcher.post(f"{header}.{body}.", asked["state"]).status_code == 401
    assert launcher.read_access()["inside"] is False


def test_launch_is_valid_once_and_in_its_browser(launcher, platform):
    asked = read_query(launcher.begin().headers["location"])
    token = platform.sign(platform.build_claims(asked["nonce"]))
    cookie, launcher.cookie = launcher.cookie, "svsa_lti=another"
    assert "this browser" in launcher.post(token, asked["state"]).text
    launcher.cookie = cookie
    assert launcher.post(token, asked["state"]).status_code == 303
    launcher.client.cookies.clear()
    again = launcher.post(token, asked["state"])
    assert again.status_code == 401
    assert "already used" in again.text
    later = read_query(launcher.begin().headers["location"])
    replayed = launcher.post(token, later["state"])
    assert "nonce" in replayed.text


@pytest.mark.parametrize("name", ["Instructor", "lnstructor", "Ad\u0430 Byron", "...", "=1+1"])
def test_name_of_the_platform_is_never_rejected_but_marked_if_it_misleads(launcher, name):
    launcher.launch(sub="user-byron", name="Ada Byron")
    for sub in ("user-90", "user-91"):
        launcher.client.cookies.clear()
        assert launcher.launch(sub=f"{sub}{name}", name=name).status_code == 303
        person = launcher.read_access()
        assert person["name"] != "Instructor"
        is_misleading = name not in ("...", "=1+1") or sub == "user-91"
        assert person["name"] == (f"{name} ({person['id'][-6:]})" if is_misleading else name)


def test_removed_user_is_not_launched_again(launcher, lab, data):
    launcher.launch(sub="user-66", name="Eve")
    eve = launcher.read_access()["id"]
    from svsa_server.access.memberships import FILE, Memberships

    assert Memberships(data / FILE).find(eve) is not None
    listener = lab.client._transport._transport.app.state.authentication
    listener.members.set_ended(eve, True)
    launcher.client.cookies.clear()
    refused = launcher.launch(sub="user-66", name="Eve")
    assert refused.status_code == 401
    assert "removed" in refused.text


def test_unknown_platform_and_foreign_target_are_rejected(launcher):
    assert launcher.begin(iss="https://evil.example.org").status_code == 401
    assert launcher.begin(client_id="other").status_code == 401
    elsewhere = {"Origin": "https://evil.example.org"}
    refused = launcher.client.post("/api/v1/join", json={}, headers=elsewhere)
    assert refused.status_code == 403


def test_public_keys_contain_no_private_part(launcher, data):
    (key,) = launcher.client.get("/lti/keys").json()["keys"]
    assert {"kid", "n", "e", "kty"} <= set(key)
    assert not {"d", "p", "q", "dp", "dq", "qi"} & set(key)
    assert (data / "lti.pem").stat().st_mode & 0o077 == 0

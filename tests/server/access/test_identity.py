"""Names that stand for one person for the life of a class, and logins that end."""

import sqlite3
from collections.abc import Iterator
from pathlib import Path

import httpx
import pytest

from svsa_server.access.memberships import FILE, Memberships
from svsa_server.access.names import clean_name, list_keys
from svsa_server.access.people import HERE_S
from svsa_server.access.roles import INSTRUCTOR, Person, Role
from tests.lab_in_process import run_lab_in_process
from tests.server.access.classroom import SHARED, Classroom, read_kind, read_person, run_class

COOKIE = "svsa_access"
ROLES = (
    "Instructor", "instructor", "INSTRUCTOR", "lnstructor", "1nstructor", "Instruct0r",
    "\u0406nstructor", "Instruct\u043er", "\uff29\uff4e\uff53tructor", "I n s t r u c t o r",
    "Instructor 2", "Instructor.", "The Instructor", "Instructor (real)", "\u00cdnstructor",
    "\u0130nstructor", "\U0001d408nstructor", "\u2139nstructor", "I-nstructor", "Dozent",
    "Преподаватель", "老师", "先生", "교수", "أستاذ", "Enseignant", "Öğretmen", "Profesora",
    "system", "Lab", "ADMIN", "admin1", "\u0410dmin", "Adrnin", "SVSA Lab", "Observer",
    "p-0123456789ab", "Teacher", "Not signed in", "|nstructor", "In_structor", "Adm1n", "Adm|n",
    "The admin1", "\u0142nstruct\u00f8r", "INSTRU\u03f9TOR", "प्रशिक्षक", "p_0123456789ab",
    "\u0440-0123456789\u0430b", "\u026a\u0274s\u1d1b\u0280\u1d1c\u1d04\u1d1b\u1d0f\u0280",
)  # fmt: skip
EMPTY = (
    "", "   ", "\u200b", "\u3164", "\u2800", "\u115f", "\u0301", "...", "---", "(", "'",
    "\t", "\ufe0f", "\u00ad",
)  # fmt: skip
HIDDEN = (
    "Ada\u200b", "Ada\u202e", "\u2066Ada", "Ada\ufe0f", "A\ndb", "Ada\u034f", "Ada\u00ad",
    "A" + "\u0301" * 8, "Ada\ue000", "Ada\x00",
)  # fmt: skip
FORMULAS = ("=1+1", "+Ada", "-Ada", "@Ada", "\uff1d1+1", "  =Ada", "\uff20Ada")
REAL = (
    "Ada", "Ada Lovelace", "O'Brien", "'t Hooft", "Jean-Luc", "José", "Nguyễn Văn An", "李雷",
    "Мария", "محمد علي", "ขวัญ", "नमस्ते", "12345", "Tom Lehrer", "Łukasz", "Labib", "Bob 2",
    "Admiral Hopper", "ALI", "Ada (2)", "Zoë 🙂",
)  # fmt: skip
ALIKE = (
    ("Ada", "ada"), ("Ada", "\u0410d\u0430"), ("Ada", " Ada "), ("Ada", "Ad\u03b1"),
    ("Ilya", "llya"), ("Bill", "Bi11"), ("Bob", "B0b"), ("Adam", "Adarn"), ("Straße", "STRASSE"),
    ("Ada Lovelace", "Ada\u00a0Lovelace"), ("Ada Lovelace", "Ada   Lovelace"),
    ("Jos\u00e9", "Jose\u0301"), ("PABEL", "\u0420\u0410\u0412\u0415L"), ("Fiona", "\ufb01ona"),
)  # fmt: skip


@pytest.fixture(scope="module")
def classroom(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Classroom]:
    with run_class(tmp_path_factory.mktemp("class"), joins="1000/minute") as room:
        yield room


@pytest.mark.parametrize("name", [*ROLES, *EMPTY, *HIDDEN, *FORMULAS], ids=ascii)
def test_name_of_a_role_or_without_a_readable_letter_is_rejected(
    classroom: Classroom, name: str
) -> None:
    body = {"name": name, "code": classroom.reported.code}
    answer = classroom.lab.client.post("/api/v1/join", json=body)
    assert answer.status_code == 422, answer.text
    assert answer.json()["violations"][0]["name"] == "name"


@pytest.mark.parametrize("name", REAL)
def test_name_of_a_person_is_accepted(name: str) -> None:
    assert clean_name(f" {name} ") == name


@pytest.mark.parametrize(("name", "other"), ALIKE, ids=ascii)
def test_look_alike_names_get_a_number(tmp_path: Path, name: str, other: str) -> None:
    members = Memberships(tmp_path / FILE)

    def add(number: int, chosen: str) -> str:
        person = Person(f"p-{number}", clean_name(chosen), Role.OPERATOR)
        return members.add(person, lambda count: f"{chosen} ({count})").name

    assert add(1, name) == clean_name(name)
    assert add(2, other).endswith("(2)")
    assert not list_keys("Ada") & list_keys("Ade")
    assert not list_keys("Ivan") & list_keys("Inan")


def test_name_stays_with_its_person_through_silence_leaving_removal_and_restart(
    tmp_path: Path,
) -> None:
    with run_class(tmp_path) as room:
        ada, bob, eve = (room.join(name) for name in ("Ada", "Bob", "Eve"))
        people = room.lab.client._transport._transport.app.state.authentication.people  # type: ignore[attr-defined]
        clock = people._clock
        people._clock = lambda: clock() + 2 * HERE_S
        bob.post("/api/v1/leave").raise_for_status()
        out = f"/api/v1/class/people/{read_person(eve)['id']}"
        room.log_in().patch(out, json={"removed": True}).raise_for_status()
        code, first = room.reported.code, read_person(ada)
    for number in (2, 3):
        with run_lab_in_process(data=str(tmp_path), classroom="1") as lab:
            for name in ("Ada", "bob", "\u0415ve"):
                body = {"name": name, "code": code}
                joined = lab.client.post("/api/v1/join", json=body).raise_for_status().json()
                assert joined["name"] == f"{name} ({number})"
                assert joined["id"] != first["id"]


def test_file_of_an_earlier_version_is_read(tmp_path: Path) -> None:
    with sqlite3.connect(tmp_path / FILE) as file:
        file.execute(
            "CREATE TABLE member (id TEXT PRIMARY KEY, name TEXT NOT NULL, role TEXT NOT NULL,"
            " return_hash BLOB, ended INTEGER NOT NULL DEFAULT 0)"
        )
        rows = [("p-1", "Ada", "operator", b"x", 0), ("p-2", "Ada", "observer", None, 1)]
        file.executemany("INSERT INTO member VALUES (?, ?, ?, ?, ?)", rows)
    members = Memberships(tmp_path / FILE)
    added = members.add(Person("p-3", "Ada", Role.OPERATOR), lambda count: f"Ada ({count})")
    assert added.name == "Ada (2)"
    assert [one.person.id for one in Memberships(tmp_path / FILE).list_all()] == [
        "p-1",
        "p-2",
        "p-3",
    ]


def carry(classroom: Classroom, cookie: str) -> httpx.Client:
    browser = classroom.open_browser()
    browser.cookies.set(COOKIE, cookie)
    return browser


def test_token_and_cookie_are_not_interchangeable(classroom: Classroom) -> None:
    ada, instructor = classroom.join("Kepler"), classroom.log_in()
    for owner in (ada, instructor):
        token = owner.post("/api/v1/tokens", json={}).json()["token"]
        cookie = owner.cookies[COOKIE]
        assert classroom.open_browser(token).get(SHARED).status_code == 200
        assert carry(classroom, token).get(SHARED).status_code == 401
        assert classroom.open_browser(cookie).get(SHARED).status_code == 401


def test_leaving_ends_cookie_and_token_and_the_code_still_admits(tmp_path: Path) -> None:
    with run_class(tmp_path) as room:
        browser = room.open_browser()
        body = {"name": "Ada", "code": room.reported.code}
        joined = browser.post("/api/v1/join", json=body).json()
        token, cookie = (
            browser.post("/api/v1/tokens", json={}).json()["token"],
            browser.cookies[COOKIE],
        )
        other = room.join("Bob")
        browser.post("/api/v1/leave").raise_for_status()
        for former in (carry(room, cookie), room.open_browser(token)):
            assert (answer := former.get(SHARED)).status_code == 401
            assert read_kind(answer) == "join_needed"
        assert other.get(SHARED).status_code == 200
        back = room.open_browser()
        code = {"code": joined["rejoin_code"]}
        assert back.post("/api/v1/rejoin", json=code).json()["id"] == joined["id"]
        assert back.get(SHARED).status_code == 200
    members = Memberships(tmp_path / FILE)
    assert not members.is_valid(Person(joined["id"], "Ada", Role.OPERATOR), "")


def test_leaving_ends_the_instructor_s_login_and_its_scripts_only(tmp_path: Path) -> None:
    with run_class(tmp_path) as room:
        first, second = room.log_in(), room.log_in()
        tokens = [one.post("/api/v1/tokens", json={}).json()["token"] for one in (first, second)]
        cookie = first.cookies[COOKIE]
        first.post("/api/v1/leave").raise_for_status()
        for former in (carry(room, cookie), room.open_browser(tokens[0])):
            assert former.get(SHARED).status_code == 401
        for present in (second, room.open_browser(tokens[1]), room.log_in()):
            assert present.get(SHARED).status_code == 200
        keys = room.lab.client._transport._transport.app.state.authentication.keys  # type: ignore[attr-defined]
        login = keys.read(cookie, "cookie").login
    assert not Memberships(tmp_path / FILE).is_valid(INSTRUCTOR, login)


def test_list_of_runs_has_the_id_of_their_owner(classroom: Classroom) -> None:
    ada = classroom.join("Hopper")
    path = f"/api/v1/sessions/{ada.post('/api/v1/sessions', json={}).json()['session']}"
    ada.post(path + "/recording", json={}).raise_for_status()
    ada.delete(path + "/recording").raise_for_status()
    owners = {run["owner"] for run in ada.get("/api/v1/runs").json()["runs"]}
    assert owners == {read_person(ada)["id"]}


def test_instructor_admits_a_member_without_cookie_and_code(classroom: Classroom) -> None:
    ada, instructor = classroom.join("Galois"), classroom.log_in()
    person = read_person(ada)
    path = "/api/v1/class/people"
    listed = instructor.get(path).raise_for_status().json()
    assert {"id": person["id"], "name": "Galois", "role": "operator", "removed": False} in listed
    new = f"{path}/{person['id']}/rejoin-code"
    assert read_kind(ada.post(new)) == "not_allowed"
    assert read_kind(ada.get(path)) == "not_allowed"
    code = instructor.post(new).raise_for_status().json()["rejoin_code"]
    back = classroom.open_browser()
    assert back.post("/api/v1/rejoin", json={"code": code}).json()["id"] == person["id"]
    assert instructor.post(f"{path}/p-none/rejoin-code").status_code == 404

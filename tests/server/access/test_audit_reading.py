"""The audit log on the instructor's page: filtered, in pages, newest first, for
instructors only.
"""

import json
import time
from collections.abc import Iterator
from logging import LogRecord
from pathlib import Path

import httpx
import pytest

from svsa_server.access import audit
from svsa_server.access.audit_reading import Question, list_operations, read_audit
from tests.server.access.classroom import SHARED, Classroom, read_kind, read_person, run_class
from tests.server.schema import SCHEMA

AUDIT = "/api/v1/class/audit"
OPERATIONS = list_operations(SCHEMA)


@pytest.fixture
def classroom(tmp_path: Path) -> Iterator[Classroom]:
    with run_class(tmp_path, control_s="1000") as room:  # no user leaves on a slow machine
        yield room


def read(browser: httpx.Client, **asked: object) -> dict:
    return browser.get(AUDIT, params=asked).raise_for_status().json()  # type: ignore[arg-type]


def test_instructor_reads_user_action_and_tick(classroom: Classroom) -> None:
    ada, bob, instructor = classroom.join("Ada"), classroom.join("Bob"), classroom.log_in()
    ada.put(SHARED + "/control", json={"by": "Ada"}).raise_for_status()
    ada.post(SHARED + "/pause").raise_for_status()
    ada.put(SHARED + "/law", json={"law": "fl"}).raise_for_status()
    tick = ada.post(SHARED + "/step", json={"ticks": 5}).json()["tick"]
    assert bob.put(SHARED + "/law", json={"law": "pd"}).status_code == 409
    for other in (ada, bob, classroom.lab.client):
        assert read_kind(other.get(AUDIT)) in ("not_allowed", "join_needed")
    reported = read(instructor)
    assert [(one["name"], one["did"], one["refused"]) for one in reported["lines"][:4]] == [
        ("Bob", "Set law", True),
        ("Ada", "Step", False),
        ("Ada", "Set law", False),
        ("Ada", "Pause", False),
    ]
    assert (reported["lines"][1]["session"], reported["lines"][1]["tick"]) == ("lab", tick)
    person = read_person(ada)["id"]
    assert {"id": person, "name": "Ada"} in reported["people"]
    settings = read(instructor, person=person, kind="settings")
    assert [(one["did"], one["status"]) for one in settings["lines"]] == [("Set law", 200)]
    assert settings["kinds"] == reported["kinds"] == ["access", "control", "session", "settings"]
    refused = read(instructor, refused=True)
    assert [one["name"] for one in refused["lines"]] == ["Bob"]


def test_action_is_readable_immediately_on_a_slow_disk(
    classroom: Classroom, monkeypatch: pytest.MonkeyPatch
) -> None:
    emit = audit.RotatingFileHandler.emit

    def emit_late(file: audit.RotatingFileHandler, line: LogRecord) -> None:
        time.sleep(0.2)
        emit(file, line)

    monkeypatch.setattr(audit.RotatingFileHandler, "emit", emit_late)
    instructor = classroom.log_in()
    for done in ("pause", "start"):
        instructor.post(f"{SHARED}/{done}").raise_for_status()
        assert read(instructor)["lines"][0]["did"] == done.capitalize()


def write(folder: Path, name: str, lines: list[dict]) -> None:
    text = "".join(json.dumps(line) + "\n" for line in lines)
    (folder / name).write_text(text, encoding="utf-8")


def build_line(second: int, path: str = "/api/v1/sessions/lab/start", **more: object) -> dict:
    time = f"2026-01-02T03:04:{second:02d}.000+00:00"
    call = {"person": "p-1", "name": "Ada", "method": "POST", "path": path, "status": 200}
    return {"time": time} | call | more


def ask(**asked: object) -> Question:
    known = {"person": "", "kind": "", "refused": None, "until": "", "page": 1, "page_size": 2}
    return Question(**(known | asked))  # type: ignore[arg-type]


def test_pages_continue_into_rotated_files_and_are_stable(
    tmp_path: Path,
) -> None:
    write(tmp_path, audit.FILE + ".2", [build_line(1)])
    write(tmp_path, audit.FILE + ".1", [build_line(2), build_line(3)])
    write(tmp_path, audit.FILE, [build_line(4), build_line(5)])
    first = read_audit(tmp_path, OPERATIONS, ask())
    assert (first["total"], [line["time"][17:19] for line in first["lines"]]) == (5, ["05", "04"])
    write(tmp_path, audit.FILE, [build_line(4), build_line(5), build_line(6)])
    pages = [read_audit(tmp_path, OPERATIONS, ask(page=n, until=first["until"])) for n in (2, 3)]
    assert [line["time"][17:19] for page in pages for line in page["lines"]] == ["03", "02", "01"]
    assert read_audit(tmp_path, OPERATIONS, ask())["total"] == 6


def test_invalid_line_and_missing_log_are_tolerated(tmp_path: Path) -> None:
    assert read_audit(tmp_path, OPERATIONS, ask())["lines"] == []
    write(tmp_path, audit.FILE, [build_line(1)])
    with (tmp_path / audit.FILE).open("a", encoding="utf-8") as file:
        file.write('{"time": "2026\n[1]\n{"no": "time"}\n')
    assert read_audit(tmp_path, OPERATIONS, ask())["total"] == 1


def test_automatic_and_platform_actions_have_descriptions(
    tmp_path: Path,
) -> None:
    time = "2026-01-02T03:04:05.000+00:00"
    idle = {"time": time, "event": "control", "why": "gone_from_queue", "person": "p-1"}
    launch = {"time": time, "action": "lti launch", "person": None, "problem": "No such key."}
    unknown = build_line(5, "/api/v1/nowhere", status=404)
    write(tmp_path, audit.FILE, [idle, launch, unknown])
    reported = read_audit(tmp_path, OPERATIONS, ask(page_size=9))["lines"]
    assert [(one["kind"], one["did"], one["why"], one["refused"]) for one in reported] == [
        ("other", "POST /api/v1/nowhere", None, True),
        ("lti", "Launch", "No such key.", True),
        ("control", "Control went on", "gone from queue", False),
    ]


def test_every_changing_operation_has_a_kind_and_a_description() -> None:
    assert len(OPERATIONS) > 60
    assert all(one.kind != "other" and one.name[0].isupper() for one in OPERATIONS)

"""A class in two browsers: joining, waiting, handing over; and the instructor's page."""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from svsa.teaching.course.file import list_exercise_files
from svsa_server.access.class_keys import ClassKeys, ShownOnce
from tests.browser.conftest import RETURNING
from tests.browser.test_accessibility import PHONE, WIDE, expect_no_violation
from tests.lab import Lab, run_lab

pytestmark = [pytest.mark.browser]


class Room(NamedTuple):
    """A class as a process, and its code and token."""

    lab: Lab
    reported: ShownOnce


@pytest.fixture(scope="module")
def room(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Room]:
    folder: Path = tmp_path_factory.mktemp("class")
    _, reported = ClassKeys.open(folder)
    assert reported is not None
    # No lease passes on only because the next step of a test took long.
    with run_lab("--class", data=str(folder), idle_operator_s="3600") as lab:
        yield Room(lab, reported)


@pytest.fixture
def open_page(browser: Browser, room: Room) -> Iterator[object]:
    """Open a page in a separate browser; all are closed at the end."""
    contexts = []

    def open_one(below: str = "/") -> Page:
        context = browser.new_context(viewport={"width": 1280, "height": 720})
        context.add_init_script(RETURNING)
        context.route("**/viser/**", lambda route: route.fulfill(body="<title>3D</title>"))
        contexts.append(context)
        page = context.new_page()
        page.goto(room.lab.url + below)
        return page

    yield open_one
    for context in contexts:
        context.close()


def join(page: Page, name: str, code: str | None = None) -> None:
    page.get_by_label("Your name").fill(name)
    if code is not None:
        page.get_by_label("Class code").fill(code)
    page.get_by_role("button", name="Join", exact=True).click()
    expect(find_control(page)).to_be_visible()


def find_control(page: Page) -> Locator:
    return page.get_by_role("region", name="Status", exact=True).locator(".is-control")


def find_banner(page: Page, words: str | re.Pattern[str]) -> Locator:
    return page.get_by_role("status").filter(has_text=words)


def test_two_students_join_wait_and_hand_over(open_page, room: Room) -> None:
    ada = open_page()
    ada.get_by_label("Your name").fill("Ada")
    ada.get_by_label("Class code").fill("XXXX-XXXX")
    ada.get_by_role("button", name="Join", exact=True).click()
    expect(ada.get_by_text("ask the instructor for the current code")).to_be_visible()
    expect_no_violation(ada, WIDE, PHONE)
    ada.set_viewport_size({"width": 1280, "height": 720})
    join(ada, "Ada", room.reported.code)
    bob = open_page(f"/#join={room.reported.code}")
    expect(bob.get_by_label("Class code")).to_have_value(room.reported.code)
    assert "#" not in bob.url
    join(bob, "Bob")

    expect(find_banner(bob, "No user is in control.")).to_be_visible()
    expect(bob.get_by_role("button", name="Fig. 4B")).to_be_disabled()
    controls = bob.locator("#controls > .groups")
    controls.focus()
    expect(controls).to_be_focused()
    expect_no_violation(bob, WIDE)
    find_control(ada).get_by_role("button", name="Request control").click()
    expect(find_control(ada)).to_contain_text("You")
    expect(ada.get_by_role("button", name="Fig. 4B")).to_be_enabled()
    find_banner(bob, "Ada is in control.").get_by_role("button", name="Request control").click()
    expect(find_banner(bob, "You are next.")).to_be_visible()
    expect(find_control(bob)).to_contain_text("your place: 1")

    bob.get_by_role("button", name="Pause", exact=True).click()
    expect(bob.get_by_role("button", name="Run", exact=True)).to_be_disabled()
    expect(ada.get_by_role("button", name="Run", exact=True)).to_be_enabled()

    find_banner(ada, "Bob waits for control.").get_by_role(
        "button", name="Hand over to Bob"
    ).click()
    expect(find_control(bob)).to_contain_text("You")
    expect(bob.get_by_role("button", name="Run", exact=True)).to_be_enabled()
    expect(ada.get_by_role("button", name="Fig. 4B")).to_be_disabled()


def test_student_leaves_the_shared_session_for_a_private_one(open_page, room: Room) -> None:
    page = open_page()
    join(page, "Cem", room.reported.code)
    page.goto(room.lab.url + "/?learn=feedback-linearization")
    banner = find_banner(page, re.compile("is in control."))
    banner.get_by_role("button", name="Open a private session").click()
    page.wait_for_url(re.compile(r"\?learn=feedback-linearization&session="))
    expect(page.get_by_text("Private session.")).to_be_visible()
    expect(page.get_by_role("button", name="Open a private session")).to_have_count(0)
    expect(find_control(page)).to_have_count(1)


def test_page_opened_before_the_login_continues_after_it(open_page, room: Room) -> None:
    page = open_page("/learn")
    exercises = page.get_by_role("region", name="Exercises").get_by_role("listitem")
    page.get_by_role("button", name="I am the instructor").click()
    expect(exercises).to_have_count(0)
    page.get_by_label("Instructor token").fill(room.reported.instructor_token)
    page.get_by_role("button", name="Enter").click()
    expect(exercises).to_have_count(len(list_exercise_files()))
    expect(page.get_by_text("This lab is a class")).to_have_count(0)


def test_instructor_sees_users_locks_and_shows_a_code(open_page, room: Room) -> None:
    student, teacher = open_page(), open_page()
    join(student, "Eve", room.reported.code)
    teacher.get_by_role("button", name="I am the instructor").click()
    teacher.get_by_label("Instructor token").fill(room.reported.instructor_token)
    teacher.get_by_role("button", name="Enter").click()
    expect(find_control(teacher)).to_be_visible()
    teacher.get_by_role("button", name="Class", exact=True).click()
    panel = teacher.get_by_role("dialog", name="The class")
    expect(panel.get_by_role("rowheader", name="Eve")).to_be_visible()
    panel.get_by_role("button", name="Lock control").click()
    expect(find_banner(student, "The instructor has locked control.")).to_be_visible()
    panel.get_by_role("button", name="New class code").click()
    expect(panel.get_by_role("img", name="QR code")).to_be_visible()
    expect(panel).to_contain_text("Only this machine reaches the lab")
    expect_no_violation(teacher, WIDE, PHONE)
    panel.get_by_role("button", name="Audit log").click()
    log = panel.get_by_role("table").filter(has_text="Result")
    expect(log.get_by_role("row", name="Renew code").first).to_contain_text("Instructor")
    panel.get_by_label("Category").select_option(label="Control")
    expect(log.get_by_role("row", name="Lock control").first).to_contain_text("done")
    expect(log.get_by_role("row", name="Renew code")).to_have_count(0)
    expect_no_violation(teacher, WIDE, PHONE)
    panel.get_by_role("button", name="Unlock control").click()
    expect(find_banner(student, "The instructor has locked control.")).to_be_hidden()

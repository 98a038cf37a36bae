"""After an exercise the session has its earlier settings."""

from collections.abc import Iterator

import pytest
from playwright.sync_api import Page, expect

from tests.browser.test_page import go_to_page
from tests.lab import Lab, run_lab

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("kept_page", "without_3d")]

EXERCISE = "feedback-linearization"


@pytest.fixture(scope="module")
def own_lab() -> Iterator[Lab]:
    """Its student has the progress of these tests alone."""
    with run_lab() as lab:
        path = f"/api/v1/course/{EXERCISE}/steps/predict-better-model/answer"
        lab.client.put(path, json={"answer": 7.5}).raise_for_status()
        yield lab


def set_up_exact_model(lab: Lab) -> dict:
    """Set up the step that makes the model exact; return the earlier settings of the session."""
    before = lab.restart() or lab.read()
    wanted = {"from": "exercise", "exercise": EXERCISE, "step": "exact-model"}
    lab.client.post(lab.session + "/experiment", json=wanted).raise_for_status()
    return before["configuration"]


def test_lab_is_opened_with_the_settings_from_before_the_exercise(page: Page, own_lab: Lab) -> None:
    before = set_up_exact_model(own_lab)
    page.goto(own_lab.url + "/?learn=" + EXERCISE + "/exact-model")
    expect(page.get_by_role("button", name="Run again")).to_be_enabled()
    assert own_lab.read()["configuration"]["law"] == "fl"
    go_to_page(page, "Lab")
    expect(page.get_by_role("button", name="Control law: NDOBC")).to_be_visible()
    assert own_lab.read()["configuration"] == before


def test_session_set_up_by_an_exercise_offers_the_earlier_settings(
    page: Page, own_lab: Lab
) -> None:
    """In a browser that opens the lab later, which changes nothing without a click."""
    before = set_up_exact_model(own_lab)
    page.goto(own_lab.url)
    banner = page.get_by_text("This session has the settings of an exercise.")
    expect(banner).to_be_visible()
    expect(page.get_by_text("Model: exact.")).to_be_visible()
    page.get_by_role("button", name="Restore earlier settings").press("Enter")
    expect(banner).to_be_hidden()
    assert own_lab.read()["configuration"] == before

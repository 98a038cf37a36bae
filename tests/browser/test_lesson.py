"""An exercise next to the live lab, completed with the keyboard alone."""

import re
from functools import partial

import pytest
from playwright.sync_api import Locator, Page, expect

from svsa.teaching.course.exercise import Exercise
from svsa.teaching.course.steps import Experiment, Explain, Predict
from tests.browser.settled import get_box, resize, until
from tests.exhaustive import exhaust
from tests.lab import Lab
from tests.teaching.course.runs import find_exercise
from tests.teaching.course.test_exercises import RIGHT

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("kept_page", "without_3d")]

FOCUSED = (
    "() => document.activeElement.closest('a, button') ? document.activeElement.innerText : ''"
)
MAX_TABS = 12


class KeyboardStudent:
    """A student with a keyboard only, at an open exercise."""

    def __init__(self, page: Page, exercise: Exercise) -> None:
        self.page, self.exercise = page, exercise

    def press_next(self, name: str) -> None:
        """Tab to a nearby control with this name, and press it."""
        named = self.page.locator("a, button").filter(has_text=re.compile(f"^{name}"), visible=True)
        expect(named.first).to_be_enabled()
        for _ in range(MAX_TABS):
            self.page.keyboard.press("Tab")
            if str(self.page.evaluate(FOCUSED)).startswith(name):
                self.page.keyboard.press("Enter")
                return
        raise AssertionError(f"{name} is more than {MAX_TABS} tabs away")

    def go_to_step(self, title: str) -> None:
        self.press_next("Next")
        expect(self.page.get_by_role("heading", name=title)).to_be_focused()

    def predict(self, answer: float) -> None:
        number = f"{answer:.4g}"
        self.page.keyboard.press("Tab")
        self.page.keyboard.type("x")
        self.page.keyboard.press("Enter")
        expect(self.page.get_by_text("“x” is not a number")).to_be_visible()
        self.page.keyboard.press("Backspace")
        self.page.keyboard.type(number)
        self.page.keyboard.press("Enter")
        expect(self.page.get_by_text(f"You predicted {number}")).to_be_visible()

    def open_arm(self, step: Experiment) -> None:
        """Leave the session of a single joint; the page is loaded again at the same step."""
        self.press_next("Open session of arm")
        self.page.wait_for_url("**session=private**")
        heading = self.page.get_by_role("heading", name=step.title)
        expect(heading).to_be_visible()
        heading.focus()

    def experiment(self, step: Experiment) -> None:
        if step.arm and "session=" not in self.page.url:
            self.open_arm(step)
        if step.free:
            self.press_next("Set up")
            expect(self.page.get_by_role("button", name="Run and record")).to_be_enabled()
            self.press_next("Run and record")
        else:
            self.press_next("Set up and run")
        expect(self.find_results().get_by_role("listitem").first).to_be_visible()
        expect(self.page.get_by_text("Saved:")).to_be_hidden()

    def choose(self, step: Explain, answer: str) -> None:
        self.page.keyboard.press("Tab")
        self.page.keyboard.press("Space")
        for _ in range([one.name for one in step.options].index(answer)):
            self.page.keyboard.press("ArrowDown")
        self.page.keyboard.press("Enter")
        expect(self.find_results().get_by_text("Right").first).to_be_visible()

    def find_results(self) -> Locator:
        return self.page.get_by_role("region", name=re.compile("^Result")).first

    def submit(self) -> None:
        if self.exercise.takes_law:
            self.press_next("Insert the law above")
            self.press_next("Test and save")
            tried = self.page.get_by_text(re.compile("^(Passed|Saved, not tested)")).first
            expect(tried).to_be_visible()
        self.page.keyboard.press("Tab")
        self.page.keyboard.type("Grace")
        self.page.keyboard.press("Enter")


def complete(hand: KeyboardStudent) -> None:
    """Complete the exercise from the first step to the submission with its default settings."""
    first, *others = hand.exercise.steps
    expect(hand.page.get_by_role("heading", name=first.title)).to_be_focused()
    answers, _ = RIGHT[hand.exercise.name]
    for step in others:
        hand.go_to_step(step.title)
        if isinstance(step, Predict):
            hand.predict(answers[step.name])
        elif isinstance(step, Explain):
            hand.choose(step, answers[step.name])
        elif isinstance(step, Experiment):
            hand.experiment(step)
    hand.submit()


def test_table_of_the_lanes_stays_in_its_column(page: Page, still_lab: Lab) -> None:
    """With the longest name and the longest values: a load that causes both errors."""
    still_lab.load_figure(load=True)
    comparisons = {"comparisons": [{"law": "prescribed_performance"}]}
    still_lab.client.put(still_lab.session + "/lanes", json=comparisons).raise_for_status()
    still_lab.jump(7)
    page.goto(still_lab.url + "/?learn=mechanism")
    expect(page.locator(".comparison .is-best").first).to_be_visible()
    for width in (1280, 1440):
        resize(page, width, 720)
        until(page, partial(is_as_wide_as_the_view, page))
    still_lab.restart()


def is_as_wide_as_the_view(page: Page) -> bool:
    table, view = (get_box(page.locator(one)) for one in (".comparison", ".view"))
    return table["width"] <= view["width"] + 1


@pytest.mark.parametrize("name", exhaust([*RIGHT], ["mechanism"]))
def test_exercise_is_completed_and_submitted_by_keyboard(page: Page, lab: Lab, name: str) -> None:
    exercise = find_exercise(name)
    lab.client.put(lab.session + "/speed", json={"speed": "max"}).raise_for_status()
    begin = {"step": exercise.steps[0].name}
    lab.client.put(f"/api/v1/course/{name}/place", json=begin).raise_for_status()
    page.goto(lab.url + "/learn")
    page.get_by_role("link", name=re.compile(exercise.title)).press("Enter")
    complete(KeyboardStudent(page, exercise))
    most = f"{exercise.max_points:g}"
    is_free = any(isinstance(one, Experiment) and one.free for one in exercise.steps)
    points = r"[\d.]+" if is_free else most
    reported = page.get_by_text(re.compile(f"Submitted: {points} of {most} points"))
    expect(reported.first).to_be_visible()

"""Typed numbers mean the same in every locale and browser: the field shows what the lab has."""

import json
import math
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import pytest
from playwright.sync_api import Browser

from tests.browser.conftest import RETURNING, leave_3d_empty
from tests.browser.firefox import find_firefox, run_firefox
from tests.lab import Lab
from tests.waiting import wait_until

pytestmark = pytest.mark.browser

PATIENCE_S = 20
FIELD = """[...document.querySelectorAll("input[role=spinbutton]")]
    .find(({ labels }) => labels[0]?.textContent.trim() === "Position")"""
SHOWN = f"""(() => {{
    const field = {FIELD};
    const ids = field.getAttribute("aria-describedby").split(" ");
    return {{
        value: field.value,
        invalid: field.getAttribute("aria-invalid"),
        keyboard: field.inputMode,
        reason: ids.map((id) => document.getElementById(id)?.textContent).join(" "),
    }};
}})()"""
VALID = [
    ("12,5", "12.5"),
    ("-0,4", "-0.4"),
    ("\u22125", "-5"),
    ("7.25", "7.25"),
    ("\u0661\u0662\u066b\u0665", "12.5"),
    ("12,3456789", "12.3456789"),
    ("\uff11\uff12\uff0e\uff15", "12.5"),
    (" 1e1 ", "10"),
]
INVALID = [
    ("", "no number"),
    ("1,000", "can mean 1000 or 1.000"),
    ("1.234,5", "more than one separator"),
    ("1 234,5", "a space"),
    ("1,234.5", "more than one separator"),
    ("1'234.5", "a space"),
    ("12,5,3", "more than one separator"),
    ("1e400", "too large"),
    ("0x10", "not a number"),
    ("12.5\u00b0", "not a number"),
    ("361", "361 deg is out of range"),
]
BOUNDS = "from \u2212360 to 360 deg"
GERMAN = {
    "1,000": "1.000",
    "no number": "keine Zahl",
    "can mean 1000 or 1.000": "kann 1000 oder 1,000 bedeuten",
    "more than one separator": "mehr als ein Trennzeichen",
    "a space": "ein Leerzeichen",
    "too large": "zu gro\u00df",
    "not a number": "keine Zahl",
    "361 deg is out of range": "361 deg liegt au\u00dferhalb",
    BOUNDS: "von \u2212360 bis 360 deg",
}
"""What the same field takes for ambiguous, and what it says, on a German page."""


class Driver(NamedTuple):
    """What the test needs of a browser."""

    evaluate: Callable[[str], Any]
    press: Callable[[str], object]
    """A key by name, or text."""
    paste: Callable[[str], object]
    turn_wheel: Callable[[int, int], object]
    """At a place of the page, up."""
    leave: Callable[[], object]
    """Leave the field."""
    is_german: bool = False

    def localize(self, text: str) -> str:
        """Return a text or a shown number in the language of the page."""
        return GERMAN.get(text, text.replace(".", ",")) if self.is_german else text


@pytest.fixture(params=["en-US", "de-DE", "firefox"])
def driver(request: pytest.FixtureRequest, lab: Lab, still: None) -> Iterator[Driver]:
    """The page of a returning user, whose reference is a constant position of 20 degrees."""
    constant = {"kind": "constant", "position_rad": math.radians(20)}
    lab.client.put(lab.session + "/position", json=constant).raise_for_status()
    if request.param == "firefox":
        with run_firefox(find_firefox(), webgl_disabled=True) as firefox:
            firefox.open(lab.url + "/icon.svg")
            firefox.evaluate(f"(() => {{ {RETURNING} }})()")
            firefox.resize(1280, 720)
            firefox.open(lab.url)
            yield Driver(
                firefox.evaluate,
                firefox.press,
                lambda text: firefox.evaluate(
                    f'document.execCommand("insertText", false, {json.dumps(text)})'
                ),
                firefox.turn_wheel,
                # A headless Firefox has no focus, so that it sends no events of focus.
                lambda: firefox.evaluate(f"{FIELD}.dispatchEvent(new FocusEvent('blur'))"),
            )
        return
    browser: Browser = request.getfixturevalue("browser")
    context = browser.new_context(locale=request.param)
    context.add_init_script(RETURNING)
    leave_3d_empty(context)
    page = context.new_page()
    page.goto(lab.url)
    context.grant_permissions(["clipboard-read", "clipboard-write"])

    def paste(text: str) -> None:
        page.evaluate("(text) => navigator.clipboard.writeText(text)", text)
        page.keyboard.press("Control+V")

    def press(key: str) -> None:
        (page.keyboard.press if len(key) > 1 and key.isascii() else page.keyboard.insert_text)(key)

    def turn_wheel(x: int, y: int) -> None:
        page.mouse.move(x, y)
        page.mouse.wheel(0, -100)

    is_german = request.param == "de-DE"
    yield Driver(page.evaluate, press, paste, turn_wheel, lambda: press("Tab"), is_german)
    context.close()


def test_field_shows_what_the_lab_has(driver: Driver, lab: Lab) -> None:
    def position_deg() -> float:
        return math.degrees(lab.read()["configuration"]["position"]["position_rad"])

    def type_text(text: str) -> None:
        driver.evaluate(f"({FIELD}.focus(), {FIELD}.select())")
        driver.press("Delete")
        for character in text:
            driver.press(character)

    def paste(text: str) -> None:
        driver.evaluate(f"({FIELD}.focus(), {FIELD}.select())")
        driver.paste(text)

    def assert_taken(expected: str) -> None:
        wait_until(
            lambda: (
                driver.evaluate(SHOWN)["value"]
                in map(driver.localize, (expected, f"{float(expected):.6g}"))
                and position_deg() == pytest.approx(float(expected), rel=1e-12)
            ),
            lambda: f"{driver.evaluate(SHOWN)}, expected {expected}; lab: {position_deg()}",
            PATIENCE_S,
        )
        assert driver.evaluate(SHOWN)["invalid"] == "false"

    wait_until(lambda: driver.evaluate(f"!!({FIELD})"))
    assert driver.evaluate(SHOWN)["keyboard"] == "decimal"
    for put in (type_text, paste):
        for finish in (lambda: driver.press("Enter"), driver.leave):
            for text, expected in VALID:
                put(text)
                finish()
                assert_taken(expected)
            lab.jump(2)  # At most 32 changes of a reference fade in at once.
    for typed, reason in INVALID:
        text = GERMAN.get(typed, typed) if driver.is_german else typed
        for put, finish in ((type_text, lambda: driver.press("Enter")), (paste, driver.leave)):
            type_text("7")
            put(text)
            finish()
            shown = driver.evaluate(SHOWN)
            assert (shown["value"], shown["invalid"]) == (text, "true")
            assert driver.localize(reason) in shown["reason"]
            assert driver.localize(BOUNDS) in shown["reason"]
            assert "Position: " in shown["reason"]
            assert position_deg() == pytest.approx(10)
            driver.evaluate(f"{FIELD}.focus()")
            driver.press("Escape")
            assert_taken("10")
    for key, expected in (
        ("ArrowUp", "11"),
        ("ArrowDown", "10"),
        ("Shift+ArrowUp", "20"),
        ("PageDown", "10"),
        ("PageUp", "20"),
    ):
        driver.press(key)
        assert_taken(expected)
    x, y = driver.evaluate(
        f"(({{ x, y }}) => [Math.round(x) + 5, Math.round(y) + 5])({FIELD}.getBoundingClientRect())"
    )
    driver.turn_wheel(x, y)
    assert_taken("21")
    driver.evaluate(f"{FIELD}.blur()")
    driver.turn_wheel(x, y)
    assert_taken("21")


def test_field_without_focus_is_rounded_and_keeps_the_commanded_value(
    driver: Driver, lab: Lab
) -> None:
    """A narrow field would cut digits off, also those before the decimal point."""
    exact = {"kind": "constant", "position_rad": 0.5}
    wait_until(lambda: driver.evaluate(f"!!({FIELD})"))
    before = lab.client.put(lab.session + "/position", json=exact).raise_for_status().json()
    wait_until(lambda: driver.evaluate(SHOWN)["value"] == driver.localize("28.6479"))
    assert driver.evaluate(f"{FIELD}.scrollWidth <= {FIELD}.clientWidth")
    driver.evaluate(f"({FIELD}.dispatchEvent(new FocusEvent('focus')), {FIELD}.focus())")
    wait_until(lambda: driver.evaluate(SHOWN)["value"] == driver.localize("28.6478897565"))
    driver.leave()
    wait_until(lambda: driver.evaluate(SHOWN)["value"] == driver.localize("28.6479"))
    driver.evaluate(f"{FIELD}.focus()")
    driver.press("ArrowUp")
    wait_until(lambda: lab.read()["revision"] != before["revision"])
    moved = math.degrees(lab.read()["configuration"]["position"]["position_rad"])
    assert moved == pytest.approx(29.6478897565, abs=1e-9), "one step, and no other change"
    assert int(lab.read()["revision"].split(".")[-1]) == int(before["revision"].split(".")[-1]) + 1

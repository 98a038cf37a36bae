"""Two writers of one setting: the page shows the other value, and can send its own again."""

import re

import pytest
from playwright.sync_api import Page, expect

from tests.browser.test_page import open_page
from tests.lab import Lab

pytestmark = pytest.mark.browser


@pytest.mark.usefixtures("kept_page", "without_3d", "still")
def test_change_by_a_script_during_typing_is_reported_and_kept(page: Page, lab: Lab) -> None:
    open_page(page, lab)
    motion = page.get_by_role("region", name="Motion", exact=True)
    field = motion.get_by_role("spinbutton", name=re.compile("Frequency"))
    expect(field).to_have_value("0.2")
    field.fill("0.3")
    theirs = lab.read()["configuration"]["position"] | {"frequency_hz": 0.25}
    lab.client.put(lab.session + "/position", json=theirs).raise_for_status()
    field.press("Enter")
    reported = motion.get_by_role("alert").filter(has_text="Another user changed this value")
    expect(reported).to_contain_text("Current value: Frequency 0.25 Hz.")
    expect(field).to_have_value("0.25")
    assert lab.read()["configuration"]["position"]["frequency_hz"] == 0.25
    with page.expect_response("**/position"):
        reported.get_by_role("button", name="Apply mine anyway").click()
    expect(reported).to_be_hidden()
    expect(field).to_have_value("0.3")
    assert lab.read()["configuration"]["position"]["frequency_hz"] == 0.3


@pytest.mark.usefixtures("kept_page", "without_3d", "still")
def test_forced_value_keeps_the_other_changes(page: Page, lab: Lab) -> None:
    open_page(page, lab)
    motion = page.get_by_role("region", name="Motion", exact=True)
    field = motion.get_by_role("spinbutton", name=re.compile("Frequency"))
    field.fill("0.3")

    def set_in_parallel(**changes: float) -> None:
        theirs = lab.read()["configuration"]["position"] | changes
        lab.client.put(lab.session + "/position", json=theirs).raise_for_status()

    set_in_parallel(offset_rad=0.1)
    field.press("Enter")
    reported = motion.get_by_role("alert").filter(has_text="Another user changed this value")
    expect(reported).to_be_visible()
    set_in_parallel(amplitude_rad=0.5)
    amplitude = motion.get_by_role("spinbutton", name=re.compile("Amplitude"))
    expect(amplitude).to_have_value(re.compile(r"^28\.6"))
    with page.expect_response("**/position"):
        reported.get_by_role("button", name="Apply mine anyway").click()
    expect(reported).to_be_hidden()
    held = lab.read()["configuration"]["position"]
    assert (held["frequency_hz"], held["amplitude_rad"], held["offset_rad"]) == (0.3, 0.5, 0.1)

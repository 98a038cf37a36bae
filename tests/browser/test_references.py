"""A time series on the page: previewed before it is applied, rejected with its row."""

import pytest
from playwright.sync_api import Page, expect

from tests.browser.test_page import choose, open_page
from tests.lab import Lab

pytestmark = pytest.mark.browser
GOOD = "time_s,stiffness_nm_per_rad\n0,15\n1,25\n2,15\n"


@pytest.mark.usefixtures("kept_page", "without_3d", "still")
def test_stiffness_csv_is_previewed_then_applied(page: Page, lab: Lab) -> None:
    open_page(page, lab)
    stiffness = page.get_by_role("region", name="Stiffness", exact=True)
    choose(stiffness.get_by_role("radio", name="Other"))
    choose(stiffness.get_by_role("radio", name="CSV"))
    text = stiffness.get_by_role("textbox", name="Time series as CSV")
    text.fill(GOOD + "1.5,20\n")
    expect(stiffness.get_by_role("alert")).to_contain_text("time_s in row 5 is 1.5 s")
    apply = stiffness.get_by_role("button", name="Apply")
    expect(apply).to_be_disabled()
    text.fill("time_s,position_deg\n0,0\n1,10\n")
    expect(stiffness.get_by_role("alert")).to_contain_text("open it under Motion")
    text.fill(GOOD)
    picture = stiffness.get_by_role("img", name="15.0 to 25.0 N·m/rad in 2.00 s")
    expect(picture).to_be_visible()
    assert lab.read()["configuration"]["stiffness"]["kind"] == "constant", "nothing is changed yet"
    expect(stiffness.get_by_text("Active: Constant.")).to_be_visible()
    apply.click()
    expect(stiffness.get_by_text("Active: CSV")).to_be_visible()
    held = lab.read()["configuration"]["stiffness"]
    assert (held["kind"], held["stiffness_nm_per_rad"]) == ("series", [15, 25, 15])

"""Non-ideal effects, switched on in the page."""

import re
from typing import Any

import pytest
from playwright.sync_api import Locator, Page, expect

from svsa.simulation.plant.effects import RIG, Effects
from tests.browser.test_page import choose, open_page, unfold
from tests.lab import Lab

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("kept_page", "without_3d", "still")]


@pytest.fixture
def realism(page: Page, lab: Lab) -> Locator:
    """The group, with all its controls in view."""
    open_page(page, lab)
    group = page.get_by_role("region", name="Realism", exact=True)
    unfold(group)
    return group


def read(lab: Lab) -> dict[str, Any]:
    return lab.read()["configuration"]


def test_rig_is_one_choice_that_a_figure_keeps(page: Page, lab: Lab, realism: Locator) -> None:
    choose(realism.get_by_role("radio", name="Rig"))
    expect(realism.get_by_text("torque one sample late")).to_be_visible()
    assert Effects.model_validate(read(lab)["effects"]) == RIG
    page.get_by_role("switch", name=re.compile("^Compare")).click()
    expect(page.get_by_role("table", name=re.compile("Comparison of controllers"))).to_be_visible()
    with page.expect_response("**/experiment"):
        page.get_by_role("button", name="Fig. 4B").click()
    assert Effects.model_validate(read(lab)["effects"]) == RIG
    expect(realism.get_by_role("radio", name="Rig")).to_be_checked()
    assert [comparison["law"] for comparison in read(lab)["comparisons"]] == ["fl"]
    assert lab.read()["loads"][0]["start_s"] == 5.0


def test_single_effect_and_model_error_are_switched(page: Page, lab: Lab, realism: Locator) -> None:
    noise = realism.get_by_role("checkbox", name="Sensor noise")
    choose(noise)
    deviation = realism.get_by_label("Deflection, std. dev.")
    expect(deviation).to_have_value("0.2")
    expect(realism.get_by_text("Custom set of effects.")).to_be_visible()
    deviation.fill("0.5")
    with page.expect_response("**/effects"):
        deviation.press("Enter")
    expect(deviation).to_have_value("0.5")
    assert read(lab)["effects"]["noise"]["deflection_std_rad"] == 0.0005
    deviation.fill("500")
    deviation.press("Enter")
    expect(realism.get_by_role("alert").filter(has_text="Deflection, std. dev.")).to_contain_text(
        "from 0 to 100 mrad"
    )
    deviation.press("Escape")
    expect(deviation).to_have_value("0.5")
    with page.expect_response("**/effects"):
        noise.press("Space")
    expect(deviation).to_have_count(0)
    assert read(lab)["effects"]["noise"] is None
    choose(noise)
    expect(deviation).to_have_value("0.5")

    row = realism.get_by_role("row", name=re.compile("link inertia"))
    expect(row.get_by_role("cell").last).to_have_text("+49 %")
    model = row.get_by_role("spinbutton", name=re.compile("Model$"))
    model.fill("0.0206")
    with page.expect_response("**/nominal"):
        model.press("Enter")
    expect(row.get_by_role("cell").last).to_have_text("+100 %")
    assert read(lab)["nominal"]["link_inertia_kg_m2"] == 0.0206
    model.fill("-1")
    model.press("Enter")
    expect(realism.get_by_role("alert").filter(has_text="link inertia, Model")).to_be_visible()
    exact = realism.get_by_role("button", name="Make the model exact")
    exact.click()
    expect(realism.get_by_role("alert")).to_have_count(0)
    expect(exact).to_be_disabled()
    assert read(lab)["nominal"] == read(lab)["actuator"]

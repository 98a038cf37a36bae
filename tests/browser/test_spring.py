"""The spring estimator on the page: its switch, and when the stiffness is known."""

import re

import pytest
from playwright.sync_api import Page, expect

from tests.browser.test_page import choose, open_page
from tests.browser.test_plots import STREAMED, find_plot
from tests.lab import Lab
from tests.waiting import wait_until

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("kept_page", "without_3d", "still")]

NUMBER = re.compile(r"^σ̂\s*\d+(\.\d+)? ± \d+(\.\d+)?$")


def test_stiffness_has_a_number_only_after_a_load_has_shown_it(page: Page, lab: Lab) -> None:
    rest = {"kind": "constant", "position_rad": 0.0}
    lab.client.put(lab.session + "/position", json=rest).raise_for_status()
    lab.jump(2)
    open_page(page, lab)
    plot = find_plot(page, "Stiffness")
    expect(plot.get_by_role("button", name=re.compile("true stiffness σ"))).to_be_visible()
    estimate = plot.locator(".legend-entry").filter(has_text="σ̂")
    expect(estimate).to_have_count(0)
    assert not page.evaluate(STREAMED, "spring_misfit")

    group = page.get_by_role("region", name="Spring estimator", exact=True)
    choose(group.get_by_role("checkbox", name="Estimate the stiffness"))
    wait_until(lambda: page.evaluate(STREAMED, "spring_misfit"))
    lab.jump(1)
    expect(estimate).to_contain_text("not known yet")
    expect(group).to_contain_text("Stiffness not known yet: apply a load")

    # On the link only: the paper's load also acts on motor 1, whose balance is measured.
    load = {"kind": "constant", "torque_nm": [2.0, 0.0, 0.0]}
    lab.client.post(lab.session + "/loads", json=load).raise_for_status()
    lab.jump(3)
    expect(estimate).to_have_text(NUMBER)
    expect(group).to_contain_text(re.compile(r"Stiffness known to ±\d+(\.\d)? %"))
    newest = "name => window.svsa.series(name).value.at(-1)"
    true = page.evaluate(newest, "stiffness_nm_per_rad")
    assert page.evaluate(newest, "stiffness_estimate_nm_per_rad") == pytest.approx(true, rel=0.05)

    off = {"is_on": False}
    lab.client.put(lab.session + "/spring", json=off).raise_for_status()
    lab.jump(1)
    expect(estimate).to_have_text("σ̂")

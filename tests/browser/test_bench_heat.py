"""Heat of a bench's motors on the page; `bench_fixture` adds the bench to a simulating lab."""

import copy
import re

import pytest
from playwright.sync_api import Page, expect

from tests.browser.bench_fixture import BENCH, HOMED, PatchedBench, describe_fault
from tests.browser.bench_page import find_bench, find_details
from tests.browser.test_page import open_page
from tests.lab import Lab

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("bench_page", "without_3d")]

HEAT_FAULT = describe_fault(
    "lever_end",
    "The torque of motor 2 was limited by heat: End of stiffness range.",
    tick=5728,
    values={"motor2_heat": 1.0, "motor2_commanded_nm": 5.0, "motor2_allowed_nm": 1.27},
)


def test_motor_limited_by_heat_is_shown_in_banner_and_table(page: Page, still_lab: Lab) -> None:
    """A fault caused by heat names the heat first, not the gains."""
    motors = copy.deepcopy(BENCH["motors"])
    bench = PatchedBench(page, status="run", homing=HOMED, fault=HEAT_FAULT)
    open_page(page, still_lab)
    find_details(page).click()
    row = page.get_by_role("row", name=re.compile("^Motor 2"))
    expect(row).to_contain_text("31 %")
    expect(page.get_by_text("torque limited by winding heat")).to_have_count(0)
    motors[1] |= {"heat": 0.985, "allowed_torque_nm": 1.83, "limited_by_heat": True}
    bench.change(motors=motors)
    expect(row).to_contain_text("limited to 1.83 N·m")
    expect(find_bench(page).get_by_role("alert")).to_have_text(
        "Motor 2: torque limited by winding heat."
    )
    expect(find_bench(page)).to_contain_text("limited to 1.83 N·m (continuous rating 1.22 N·m)")
    bench.change(status="fault")
    page.get_by_text("Causes and remedies").press("Enter")
    expect(page.get_by_text("Let the motor cool")).to_be_visible()


def test_permitted_time_of_a_load_is_shown_next_to_it(page: Page, still_lab: Lab) -> None:
    bench = PatchedBench(page, status="run", homing=HOMED)
    bench.endurance = {
        "motor": "motor2",
        "torque_nm": 2.25,
        "lasting_torque_nm": 1.22,
        "seconds": 3.79,
    }
    open_page(page, still_lab)
    expect(page.get_by_text("Motor 2 overheats in about 4 s, starting cold")).to_be_visible()
    bench.endurance |= {"motor": "motor1", "seconds": 0.4}
    page.get_by_role("radio", name="Paper’s torques").press("Space")
    expect(page.get_by_text("Motor 2 overheats")).to_have_count(0)
    expect(page.get_by_text("Motor 1 overheats in less than a second")).to_be_visible()
    asked = [body for call, body in bench.calls if call == "bench/endurance"]
    kinds = dict.fromkeys(load["kind"] for load in asked)
    assert list(kinds) == ["mass", "paper"], "asked again after a moment without the lab"

"""`svsa serve --bench` with another actuator: emulator, loop and server, over python-can."""

from pathlib import Path

import pytest

from svsa.actuators.installed import get_mechanism
from svsa.runs.definition.experiment import build_default_load, choose_stiffness
from tests.server.sessions.bench_lab import BenchLab, run_bench_lab
from tests.waiting import wait_until

pytestmark = pytest.mark.wall_clock
NAME = "qbmove"


def test_bench_of_another_actuator_is_served_holds_its_load_and_is_recorded(tmp_path: Path) -> None:
    mechanism = get_mechanism(NAME)
    with run_bench_lab(tmp_path, NAME) as bench:
        state = bench.read()
        assert state["actuator"]["name"] == NAME
        assert state["configuration"]["actuator"] == mechanism.prototype.model_dump(mode="json")
        assert state["bench"]["problems"] == []
        bench.make_ready()
        run_id = bench.ask("/recording", {})["recording"]["run_id"]
        with bench.watched():
            bench.ask("/start")
            bench.wait_for("run")
            sigma = 1.3 * choose_stiffness(mechanism)
            bench.ask("/position", {"kind": "constant", "position_rad": 0.2}, "PUT")
            reference = {"kind": "constant", "stiffness_nm_per_rad": sigma}
            bench.ask("/stiffness", reference, "PUT")
            # Both references are faded over first: under the load as well, the spring may reach the
            # end of its range.
            bench.wait_for_ticks(2000)
            load = build_default_load(mechanism).changed(start_s=None)
            bench.ask("/loads", load.model_dump(mode="json", exclude={"start_s"}))
            expect_held(bench, sigma, load.torque_nm[0])
            bench.ask("/pause")
            bench.wait_for("ready")
            assert bench.is_at_zero()
        bench.ask("/recording", method="DELETE")
        runs = f"/api/v1/runs/{run_id}"
        wait_until(lambda: bench.lab.client.get(runs).json()["state"] != "recording")
        run = bench.lab.client.get(runs).json()
        assert run["settings"]["name"].startswith(f"{mechanism.title} · ")
        assert run["configuration"]["actuator"]["mechanism"] == NAME


def expect_held(bench: BenchLab, sigma: float, torque: float) -> None:
    state = bench.wait_for_ticks(3000)
    assert state["fault"] is None
    sample = state["sample"]
    assert sample["position_rad"] == pytest.approx(0.2, abs=0.01)
    assert sample["stiffness_nm_per_rad"] == pytest.approx(sigma, rel=0.05)
    assert sample["estimate_link_nm"] == pytest.approx(torque, rel=0.4)

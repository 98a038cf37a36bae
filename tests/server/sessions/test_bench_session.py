"""The lab with a bench: `svsa serve --bench`, and an emulator that waits for its loop."""

from collections.abc import Iterator

import pytest

from tests.server.sessions.bench_lab import BenchLab, run_bench_lab
from tests.server.test_monitoring import read_metrics
from tests.waiting import wait_until

pytestmark = pytest.mark.wall_clock

ZERO_S = 5.0
LASTING_S = 60.0
"""Duration of a manual load whose end these tests do not wait for on any machine."""


@pytest.fixture(scope="module")
def bench(tmp_path_factory: pytest.TempPathFactory) -> Iterator[BenchLab]:
    with run_bench_lab(tmp_path_factory.mktemp("bench")) as running:
        yield running


@pytest.mark.smoke
def test_bench_is_armed_and_homed_step_by_step_in_order_only(bench: BenchLab) -> None:
    state = bench.read()
    assert state["bench"]["status"] == "off"
    assert state["bench"]["problems"] == []
    assert state["status"] == "paused"
    assert "arm it" in refuse_watched(bench)
    bench.emulator.control.home()
    bench.ask("/bench/arm")
    assert "READY" in bench.expect_rejection("/bench/home", {"step": "link", "by": "Ada"})
    bench.wait_for("ready")
    assert bench.read()["bench"]["emulated"] is True
    assert "zero mark of the link" in refuse_watched(bench)
    wrong = bench.lab.client.post(
        bench.lab.session + "/bench/home", json={"step": "motor2", "by": "Ada"}
    )
    assert wrong.status_code in (409, 422)
    for step, following in (("link", "motor1"), ("motor1", "motor2"), ("motor2", None)):
        homing = bench.ask("/bench/home", {"step": step, "by": "Ada"})["bench"]["homing"]
        assert homing["next_step"] == following
        assert homing["instruction"]
    assert "No client watches" in bench.expect_rejection("/start")
    assert [mode for mode, _ in bench.read_drives()] == [2, 2]
    assert bench.is_at_zero()


def refuse_watched(bench: BenchLab) -> str:
    with bench.watched():
        return bench.expect_rejection("/start")


def test_run_takes_commands_at_a_tick_and_has_its_twin(bench: BenchLab) -> None:
    bench.make_ready()
    run_id = bench.ask("/recording", {"name": "A run", "tags": ["mine"]})["recording"]["run_id"]
    with bench.watched():
        bench.ask("/start")
        bench.wait_for("run")
        bench.wait_for_ticks()
        bench.ask("/position", {"kind": "constant", "position_rad": 0.3}, "PUT")
        bench.ask("/stiffness", {"kind": "constant", "stiffness_nm_per_rad": 40.0}, "PUT")
        bench.ask("/gains", {"stiffness_coefficients": [900.0, 60.0]}, "PUT")
        bench.ask("/law", {"law": "fl"}, "PUT")
        bench.ask("/law", {"law": "ndobc"}, "PUT")
        bench.ask("/loads", {"kind": "constant", "torque_nm": [1.0, 0.0, 0.0]})
        state = bench.wait_for_ticks(1500)
        assert state["status"] == "running"
        assert state["fault"] is None
        assert bench.emulator.control.read_state()["loads"] == 1
        assert len(state["lanes"]) == 2
        assert [lane["law"] for lane in state["lanes"]] == ["ndobc", "ndobc"]
        assert all(lane["since_load"] is not None for lane in state["lanes"])
        sample = state["sample"]
        assert sample["position_rad"] == pytest.approx(0.3, abs=0.05)
        assert sample["stiffness_nm_per_rad"] == pytest.approx(40.0, abs=2.0)
        assert sample["disturbance_link_nm"] is None
        assert sample["estimate_link_nm"] == pytest.approx(1.0, abs=0.4)
        assert 0.0 < abs(sample["position_residual_rad"]) < 0.1
        for refused in (("/step", {"ticks": 1}, "POST"), ("/speed", {"speed": 2.0}, "PUT")):
            assert "real time" in bench.expect_rejection(*refused)
        assert "stop it" in bench.expect_rejection("/reset")
        bench.ask("/loads", method="DELETE")
        bench.ask("/pause")
        bench.wait_for("ready")
        assert bench.is_at_zero()
        assert bench.read()["status"] == "paused"
    bench.ask("/recording", method="DELETE")
    check_recording(bench, run_id)


def check_recording(bench: BenchLab, run_id: str) -> None:
    """The recording names its bench, has every command with its tick, and is not resimulated."""
    client, runs = bench.lab.client, f"/api/v1/runs/{run_id}"
    wait_until(lambda: client.get(runs).json()["state"] != "recording")
    run = client.get(runs).json()
    assert set(run["tags"]) == {"mine", "emulated"}
    assert run["ticks"] > 1000
    commands = run["commands"]
    ticks = [command["tick"] for command in commands]
    kinds = [command["command"]["kind"] for command in commands]
    assert kinds[:3] == ["position", "stiffness", "gains"]
    assert ticks == sorted(ticks)
    assert 0 < ticks[0] < ticks[-1] <= run["ticks"]
    opening = {"from": "run", "id": run["id"], "tick": 10}
    for path, body in ((runs + "/verify", None), ("/api/v1/sessions", opening)):
        answer = client.post(path, json=body)
        assert answer.status_code == 409, answer.text
        assert "emulated" in answer.json()["detail"]


def test_quick_stop_is_latched_until_it_is_cleared(bench: BenchLab) -> None:
    with bench.running():
        bench.wait_for_ticks(200)
        bench.ask("/quick-stop")
        wait_until(bench.is_at_zero, longest_s=ZERO_S)
        state = bench.read()
        assert (state["status"], state["bench"]["status"]) == ("fault", "fault")
        assert state["fault"]["code"] == "quick_stop"
        for refused in ("/start", "/bench/arm"):
            assert "fault" in bench.expect_rejection(refused)
        bench.ask("/bench/clear")
        bench.wait_for("off")
        assert bench.read()["fault"] is None


def test_loss_of_the_last_viewer_stops_the_bench(bench: BenchLab) -> None:
    with bench.running():
        with bench.watched():
            bench.wait_for_ticks(100)
        bench.wait_for_ticks(1200)
        assert bench.status == "run", "one still watches"
    bench.wait_for("ready")
    assert bench.is_at_zero()
    assert bench.read()["fault"] is None


def test_manual_load_is_one_load_from_the_first_update_to_its_end(bench: BenchLab) -> None:
    bench.make_ready()
    run_id = bench.ask("/recording", {"name": "A push"})["recording"]["run_id"]
    with bench.watched():
        bench.ask("/position", {"kind": "constant", "position_rad": 0.0}, "PUT")
        bench.ask("/start")
        bench.wait_for("run")
        for torque, hold_s in ((0.4, LASTING_S), (0.8, LASTING_S), (1.2, 2.0)):
            assert bench.emulator.control.read_state()["loads"] == (0 if torque == 0.4 else 1)
            push = {"kind": "push", "torque_nm": [torque, 0.0, 0.0], "hold_s": hold_s}
            load = bench.ask("/loads", push)
            assert load["id"] == 1, "reported again it is the same"
            if hold_s == LASTING_S:
                state = bench.wait_for_ticks(500)
                assert state["sample"]["estimate_link_nm"] == pytest.approx(torque, abs=0.3)
        wait_until(lambda: not bench.read()["loads"][0]["active"], bench.describe)
        wait_until(lambda: bench.emulator.control.read_state()["loads"] == 0)
        state = bench.wait_for_ticks(1000)
        assert state["fault"] is None
        assert state["sample"]["estimate_link_nm"] == pytest.approx(0.0, abs=0.3)
        events = {event["kind"]: event for event in state["events"]}
        assert [event["kind"][:4] for event in state["events"]].count("load") == 2
        bench.ask("/pause")
        bench.wait_for("ready")
    bench.ask("/recording", method="DELETE")
    client, run = bench.lab.client, f"/api/v1/runs/{run_id}"
    wait_until(lambda: client.get(run).json()["state"] != "recording")
    reported = client.get(run).json()["commands"]
    pushes = [each for each in reported if each["command"]["kind"] == "load"]
    assert [each["command"]["argument"]["torque_nm"][0] for each in pushes] == [0.4, 0.8, 1.2]
    end_tick = events["load_off"]["tick"]
    assert events["load_on"]["tick"] == pushes[0]["tick"]
    assert end_tick == pushes[-1]["tick"] + 2000
    segment = {"channels": "estimate_link_nm", "start_s": 1e-3 * end_tick - 0.5}
    seen = client.get(f"{run}/samples", params=segment).raise_for_status().json()
    bench_lane, twin = (lane["estimate_link_nm"] for lane in seen["lanes"].values())
    for estimates in (bench_lane, twin):
        assert estimates[0] == pytest.approx(1.2, abs=0.3)
        assert estimates[-1] == pytest.approx(0.0, abs=0.3)


def test_metrics_report_the_ticks_of_the_loop_and_their_lateness(bench: BenchLab) -> None:
    metrics = read_metrics(bench.lab.client)
    assert metrics["svsa_bench_loop_alive",] == 1
    assert metrics["svsa_bench_ticks_total",] > 0
    late = "svsa_bench_tick_lateness_seconds"
    assert metrics[late, "1"] >= metrics[late, "0.99"] >= metrics[late, "0.5"] > 0

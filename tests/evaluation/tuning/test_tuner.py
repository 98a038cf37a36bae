"""`svsa tune`: the same for every law, repeatable, and never worse than what was there."""

import json
import math
from itertools import pairwise

import numpy as np
import pytest
from typer.testing import CliRunner

import svsa
from svsa.cli import app
from svsa.control.installed import get_law, list_law_names
from svsa.evaluation.ranking.cost import (
    MAX_FAULT,
    MIN_FAULT,
    RunCost,
    compute_cost,
    compute_torque_change,
)
from svsa.evaluation.tuning.file import format_tuned
from svsa.evaluation.tuning.search_space import build_space
from svsa.evaluation.tuning.training import TRAINING
from svsa.evaluation.tuning.tuner import build_runs, count_sobol, tune
from svsa.runs.configuration import parse_design

SHORT = {"runs": TRAINING[:2], "duration_s": 0.3}
SLUGGISH = {"position_pole_rad_per_s": 8.0, "stiffness_pole_rad_per_s": 6.0}


def build_sluggish():
    """FL with integral action at poles that nobody would choose."""
    parameters = get_law("fl_integral").parameters(**SLUGGISH)
    return svsa.load_prototype().changed(parameters={"fl_integral": parameters})


def test_a_planted_optimum_is_found(monkeypatch):
    """A cost whose least lies at known values: the search ends beside it, whatever the law."""
    planted = {"position_pole_rad_per_s": 33.0, "stiffness_pole_rad_per_s": 61.0}

    def measure(configuration, duration_s):
        found = configuration.parameters["fl_integral"]
        far = (math.log(getattr(found, name) / best) for name, best in planted.items())
        return RunCost(sum(distance**2 for distance in far))

    monkeypatch.setattr("svsa.evaluation.tuning.tuner.measure_cost", measure)
    tuned = tune("fl_integral", budget=100)
    found = tuned.design.parameters["fl_integral"]
    for name, best in planted.items():
        assert getattr(found, name) == pytest.approx(best, rel=0.01)
    assert tuned.best.cost < 1e-3 * min(
        trial.cost for trial in tuned.trials if trial.stage == "sobol"
    )


def test_the_same_search_finds_the_same_and_another_seed_tries_others():
    first, again, other = (tune("pd", budget=6, seed=seed, **SHORT) for seed in (3, 3, 4))
    assert first.trials == again.trials
    assert [trial.values for trial in first.trials[1:]] != [t.values for t in other.trials[1:]]


def test_a_poor_choice_is_bettered_in_real_runs():
    """Slow poles leave degrees under the training loads; eight candidates find better ones."""
    tuned = tune("fl_integral", budget=8, present=build_sluggish(), runs=TRAINING[:1])
    assert tuned.is_complete
    assert len(tuned.trials) == 9
    assert tuned.start.values == tuple(SLUGGISH.values())
    assert tuned.best.cost < 0.5 * tuned.start.cost
    design = tuned.design
    (run,) = build_runs(design, "fl_integral", TRAINING[:1])
    result = svsa.simulate(run, duration_s=tuned.duration_s)
    assert compute_cost(result, tuned.duration_s) == tuned.best.runs[0]
    assert tuned.best.runs[0].cost == tuned.best.cost


def test_it_ends_where_it_is_told_to_and_keeps_the_best():
    seen = []
    tuned = tune(
        "pd", budget=40, on_trial=seen.append, is_cancelled=lambda: len(seen) >= 3, **SHORT
    )
    assert not tuned.is_complete
    assert list(tuned.trials) == seen
    assert len(seen) == 3
    assert "2 of 40 candidates" in format_tuned(tuned)


def test_where_it_is_told_to_end_at_once_it_has_the_present_design():
    tuned = tune("pd", budget=40, is_cancelled=lambda: True, **SHORT)
    assert [trial.stage for trial in tuned.trials] == ["present"]
    assert tuned.best == tuned.start


def test_ctrl_c_keeps_the_best():
    def stop(trial):
        if trial.number == 2:
            raise KeyboardInterrupt

    tuned = tune("pd", budget=40, on_trial=stop, **SHORT)
    assert len(tuned.trials) == 3
    assert tuned.best == min(tuned.trials, key=lambda trial: trial.cost)


def test_ctrl_c_at_the_command_saves_the_best_and_exits_with_130(tmp_path, monkeypatch):
    def stop_early(law, on_trial, **given):
        return tune(law, **(given | SHORT | {"is_cancelled": lambda: True}))

    monkeypatch.setattr("svsa.evaluation.tuning.tuner.tune", stop_early)
    found = CliRunner().invoke(app, ["tune", "pd", "--output", str(tmp_path / "pd.toml")])
    assert found.exit_code == 130
    assert "Broken off after 0 of" in found.stdout
    assert (tmp_path / "pd.toml").exists()


def test_every_law_is_searched_within_what_it_declares():
    """Poles from 20 to 80 rad/s, the observer of the load from 20 to 150, for all alike."""
    for law in list_law_names():
        space = build_space(law)
        for axis in space.axes:
            assert axis.low < axis.high, (law, axis)
            if axis.name.endswith("_pole_rad_per_s"):
                assert (axis.low, axis.high) == (20.0, 80.0)
            if axis.name == "observer_rad_per_s":
                assert (axis.low, axis.high) == (20.0, 150.0)
        for share in (0.0, 0.37, 1.0):
            values = [axis.compute_value(share) for axis in space.axes]
            design = space.set_design(svsa.load_prototype(), values)
            assert space.read_values(design) == pytest.approx(values, rel=1e-9)
            found = [a.compute_share(v) for a, v in zip(space.axes, values, strict=True)]
            assert found == pytest.approx([share] * len(values), abs=1e-9)


def test_what_says_which_law_it_is_is_held_and_not_searched():
    assert "estimate_share" not in {axis.name for axis in build_space("esp").axes}
    assert "period_s" not in {axis.name for axis in build_space("ilc").axes}
    tuned = tune("esp", budget=1, held={"estimate_share": 0.0}, **SHORT)
    assert tuned.design.parameters["esp"].estimate_share == 0.0
    assert "with estimate_share = 0" in format_tuned(tuned)


@pytest.mark.parametrize(
    ("law", "held", "reported"),
    [
        ("no_law", {}, "installed here"),
        ("ndobc", {"a": 1.0}, "takes the run's gains"),
        ("esp", {"no_name": 1.0}, "no_name"),
        ("pd", {"motor1_damping": 9.0}, "motor1_damping is 9"),
    ],
)
def test_what_cannot_be_searched_is_refused(law, held, reported):
    with pytest.raises(svsa.ParameterError, match=reported):
        tune(law, budget=1, held=held, **SHORT)


def test_a_fault_costs_six_to_twelve_and_shaking_costs():
    run = svsa.simulate("4a", "fl", duration_s=0.1)
    e = math.degrees(math.sqrt(np.mean(run.position_error_rad**2)))
    sigma = math.sqrt(np.mean(run.stiffness_error_nm_per_rad**2))
    squares = np.diff(run.torque1_nm) ** 2 + np.diff(run.torque2_nm) ** 2
    assert compute_torque_change(run) == pytest.approx(math.sqrt(np.mean(squares)), rel=1e-12)
    expected = e + 0.1 * sigma + 0.3 * compute_torque_change(run)
    found = compute_cost(run, 0.1)
    assert found.cost == pytest.approx(expected, rel=1e-12)
    assert found.fault == ""
    strong = svsa.ConstantLoad(torque_nm=(40.0, 0.0, 0.0), start_s=0.05)
    broken = svsa.simulate("4a", "pd", duration_s=1.0, loads=(strong,))
    assert broken.fault is not None
    assert compute_cost(broken, 1.0).fault == "deflection_limit"
    costs = [compute_cost(broken, duration_s).cost for duration_s in (0.2, 1.0, 10.0)]
    assert all(MIN_FAULT < cost < MAX_FAULT for cost in costs)
    assert all(sooner > later for later, sooner in pairwise(costs))


def test_half_of_a_budget_is_sobol_points():
    assert [count_sobol(budget) for budget in (1, 2, 8, 124, 1000)] == [1, 1, 4, 64, 512]


def test_the_file_says_its_source_and_goes_back_into_a_run(tmp_path):
    """FL and NDOBC are tuned in [gains] and [observer], others in a table of their own."""
    for law, section in (("ndobc", "gains"), ("fl_integral", "parameters.fl_integral")):
        tuned = tune(law, budget=2, **SHORT)
        path = tmp_path / f"{law}.toml"
        path.write_text(format_tuned(tuned), encoding="utf-8")
        text = path.read_text(encoding="utf-8")
        for run in tuned.runs:
            assert f"{run.name}: {run.title}" in text
        source = f"svsa tune {law}: cost {tuned.best.cost:.4g}"
        assert source in text.split(f"[{section}.")[1]
        assert parse_design(text) == tuned.design
        here = svsa.simulate("4a", law, duration_s=0.05, parameters=path)
        there = svsa.simulate("4a", law, duration_s=0.05, parameters=tuned.design)
        assert np.array_equal(here.samples, there.samples)


def test_the_command_writes_a_file_or_prints_all_trials(tmp_path):
    path = tmp_path / "mine.toml"
    common = ["tune", "fl_integral", "--budget", "2", "--seed", "1"]
    runner = CliRunner()
    table = runner.invoke(app, [*common, "--output", str(path)], catch_exceptions=False).stdout
    assert "position_pole_rad_per_s" in table
    assert all(run.name in table for run in TRAINING)
    reported = json.loads(runner.invoke(app, [*common, "--json"], catch_exceptions=False).stdout)
    assert [trial["stage"] for trial in reported["trials"]] == ["present", "sobol", "local"]
    written = svsa.read_design(path).parameters["fl_integral"]
    assert written.position_pole_rad_per_s == reported["best"]["values"][0]
    assert reported["best"]["cost"] == min(trial["cost"] for trial in reported["trials"])
    with pytest.raises(svsa.ParameterError, match=r"hold is .a=b.: it must be NAME=VALUE"):
        runner.invoke(app, [*common, "--hold", "a=b"], catch_exceptions=False)

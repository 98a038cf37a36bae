"""`svsa tune`: one search, cost and noise limit for every law; repeatable and resumable."""

import json
import math

import numpy as np
import pytest
from typer.testing import CliRunner

import svsa
from svsa.cli import app
from svsa.control.installed import get_law, list_law_names
from svsa.evaluation.campaign.journal import Journal
from svsa.evaluation.trials import build_training
from svsa.evaluation.tuning import tuned_law
from svsa.evaluation.tuning.file import format_tuned
from svsa.evaluation.tuning.judge import LOUD, Judgment, TrialSet, find_noise_limit, judge
from svsa.evaluation.tuning.search_space import build_space
from svsa.evaluation.tuning.tuned_law import TunedLaw, build_tuned_law, load_tuned_laws
from svsa.evaluation.tuning.tuner import tune
from svsa.runs.definition.design_file import parse_design

pytestmark = pytest.mark.long

LAW = "fl_integral"
SHORT = {"trials": 2, "validation": 2}


def build_design(position, stiffness):
    poles = {"position_pole_rad_per_s": position, "stiffness_pole_rad_per_s": stiffness}
    return svsa.load_prototype().changed(parameters={LAW: get_law(LAW).parameters(**poles)})


@pytest.fixture
def planted(monkeypatch):
    """A cost with a minimum at known values, without any run."""
    best = {"position_pole_rad_per_s": 33.0, "stiffness_pole_rad_per_s": 61.0}

    def measure(trials, law, design):
        found = design.parameters[law] if law in design.parameters else get_law(law).parameters()
        far = (math.log(getattr(found, name) / value) for name, value in best.items())
        return Judgment(sum(distance**2 for distance in far), 1.0, 1, 1)

    monkeypatch.setattr("svsa.evaluation.tuning.tuner.judge", measure)
    return best


def test_planted_optimum_is_found(planted):
    tuned = tune(LAW, budget=160, **SHORT)
    found = tuned.design.parameters[LAW]
    for name, best in planted.items():
        assert getattr(found, name) == pytest.approx(best, rel=0.02)
    assert tuned.best in tuned.finals
    assert len({one.values for one in tuned.finals}) == len(tuned.finals) == 11


@pytest.mark.usefixtures("planted")
def test_interrupted_search_continues_to_the_same_result():
    whole = tune(LAW, budget=40, **SHORT)
    seen = []
    stopped = tune(
        LAW, budget=40, on_candidate=seen.append, is_cancelled=lambda: len(seen) >= 21, **SHORT
    )
    assert not stopped.is_complete
    assert "20 of 40 candidates" in format_tuned(stopped)
    again = tune(LAW, budget=40, known=seen, **SHORT)
    assert again.candidates == whole.candidates
    assert again.finals == whole.finals
    assert [one.values for one in tune(LAW, budget=8, seed=1, **SHORT).candidates[1:]] != [
        one.values for one in whole.candidates[1:9]
    ]


@pytest.mark.usefixtures("planted")
def test_ctrl_c_saves_the_best_candidate(tmp_path, monkeypatch):
    def stop(candidate):
        if candidate.number == 2:
            raise KeyboardInterrupt

    tuned = tune(LAW, budget=40, on_candidate=stop, **SHORT)
    assert len(tuned.candidates) == 3
    assert tuned.best == min(tuned.candidates, key=lambda one: one.judgment.cost)
    at_once = tune(LAW, budget=40, is_cancelled=lambda: True, **SHORT)
    assert [one.stage for one in at_once.candidates] == ["present"]

    def stop_early(law, **given):
        return tune(law, **(given | {"is_cancelled": lambda: True}))

    monkeypatch.setattr("svsa.evaluation.tuning.tuner.tune", stop_early)
    found = CliRunner().invoke(app, ["tune", LAW, "--output", str(tmp_path / "mine.toml")])
    assert found.exit_code == 130
    assert "Interrupted after 0 of" in found.stdout
    assert (tmp_path / "mine.toml").exists()


@pytest.mark.usefixtures("planted")
def test_killed_command_continues_to_the_same_file(tmp_path, monkeypatch):
    whole, part = tmp_path / "whole.toml", tmp_path / "part.toml"
    journal = tmp_path / "part.toml.search"
    options = [LAW, "--budget", "20", "--trials", "2", "--validation", "2", "--output"]
    assert CliRunner().invoke(app, ["tune", *options, str(whole)]).exit_code == 0

    def end(journal, trial, write=Journal.write):
        write(journal, trial)
        if trial["number"] == 9:
            raise SystemError  # as little is saved as by a kill

    with monkeypatch.context() as patch:
        patch.setattr(Journal, "write", end)
        assert isinstance(
            CliRunner().invoke(app, ["tune", *options, str(part)]).exception, SystemError
        )
    assert not part.exists()
    assert len(journal.read_text().splitlines()) == 1 + 10
    assert CliRunner().invoke(app, ["tune", *options, str(part)]).exit_code == 0
    assert part.read_text() == whole.read_text()
    assert not journal.exists()


@pytest.mark.exhaustive
def test_poor_gains_are_improved_in_real_runs_below_the_noise_limit():
    tuned = tune(LAW, budget=16, present=build_design(8.0, 6.0), trials=8, validation=8)
    assert tuned.is_complete
    before, after = tuned.finals[0].judgment, tuned.best.judgment
    assert after.cost < before.cost - 0.3
    assert after.torque_variation_nm_per_s <= find_noise_limit()
    assert judge(TrialSet(build_training(0, 8)), LAW, tuned.design).trials == 8


@pytest.mark.exhaustive
def test_cost_and_noise_limit_are_as_defined():
    """NDOBC with the declared gains is at the limit; fast poles are above it and do not run."""
    trials, design = TrialSet(build_training(0, 8)), svsa.load_prototype()
    one = judge(trials, "ndobc", design)
    assert one.torque_variation_nm_per_s == find_noise_limit()
    assert one.trials == 8
    assert one.held <= 8
    loud = judge(trials, LAW, build_design(150.0, 40.0))
    assert loud.trials == 0
    assert loud.cost > LOUD
    worse = judge(trials, LAW, build_design(6.0, 6.0))
    assert worse.cost > one.cost
    assert worse.held < one.held


def test_every_law_is_searched_within_its_declared_bounds():
    """Poles from 20 to 80 rad/s and the observer gain from 20 to 150 for all laws."""
    for law in list_law_names():
        space = build_space(law)
        for axis in space.axes:
            assert axis.low < axis.high, (law, axis)
            if axis.name.endswith("_pole_rad_per_s"):
                assert (axis.low, axis.high) == (20.0, 80.0)
            if axis.name == "observer_rad_per_s":
                assert (axis.low, axis.high) == (20.0, 150.0)
        for share in (0.0, 0.37, 1.0):
            values = space.place([share] * len(space.axes))
            design = space.set_design(svsa.load_prototype(), values)
            assert space.read_values(design) == pytest.approx(values, rel=1e-9)
            assert space.compute_shares(values) == pytest.approx(share, abs=1e-9)


def test_identifying_parameters_of_a_law_are_not_searched():
    assert "estimate_share" not in {axis.name for axis in build_space("esp").axes}
    assert "period_s" not in {axis.name for axis in build_space("ilc").axes}
    space = build_space("esp", {"estimate_share": 0.0})
    design = space.set_design(svsa.load_prototype(), space.read_values(svsa.load_prototype()))
    assert design.parameters["esp"].estimate_share == 0.0


@pytest.mark.parametrize(
    ("law", "held", "reported"),
    [
        ("no_law", {}, "installed here"),
        ("ndobc", {"a": 1.0}, "takes the run's gains"),
        ("esp", {"no_name": 1.0}, "no_name"),
        ("pd", {"motor1_damping": 9.0}, "motor1_damping is 9"),
    ],
)
def test_unsearchable_parameter_is_rejected(law, held, reported):
    with pytest.raises(svsa.ParameterError, match=reported):
        tune(law, budget=1, held=held, **SHORT)


@pytest.mark.exhaustive
def test_file_names_its_source_and_configures_a_run(tmp_path):
    """FL and NDOBC are tuned in [gains] and [observer], others in a table of their own."""
    for law, section in (("ndobc", "gains"), (LAW, f"parameters.{LAW}")):
        tuned = tune(law, budget=2, **SHORT)
        path = tmp_path / f"{law}.toml"
        path.write_text(format_tuned(tuned), encoding="utf-8")
        text = path.read_text(encoding="utf-8")
        source = f"svsa tune {law}: cost {tuned.best.judgment.cost:.4g}"
        assert source in text.split(f"[{section}.")[1]
        assert parse_design(text) == tuned.design
        here = svsa.simulate("4a", law, duration_s=0.05, parameters=path)
        there = svsa.simulate("4a", law, duration_s=0.05, parameters=tuned.design)
        assert np.array_equal(here.samples, there.samples)


@pytest.mark.usefixtures("planted")
def test_command_writes_a_file_or_prints_all_candidates(tmp_path):
    path = tmp_path / "mine.toml"
    common = ["tune", LAW, "--budget", "2", "--seed", "1", "--trials", "2", "--validation", "2"]
    runner = CliRunner()
    table = runner.invoke(app, [*common, "--output", str(path)], catch_exceptions=False).stdout
    assert "position_pole_rad_per_s" in table
    reported = json.loads(runner.invoke(app, [*common, "--json"], catch_exceptions=False).stdout)
    assert [one["stage"] for one in reported["candidates"]] == ["present", "search", "search"]
    written = svsa.read_design(path).parameters[LAW]
    assert written.position_pole_rad_per_s == reported["best"]["values"][0]
    assert reported["best"]["cost"] == min(one["cost"] for one in reported["finals"])
    with pytest.raises(svsa.ParameterError, match=r"hold is .a=b.: it must be NAME=VALUE"):
        runner.invoke(app, [*common, "--hold", "a=b"], catch_exceptions=False)
    with pytest.raises(svsa.ParameterError, match="one law, or --all"):
        runner.invoke(app, ["tune"], catch_exceptions=False)


@pytest.mark.usefixtures("planted")
def test_all_laws_are_tuned_once_with_a_file_each(tmp_path, monkeypatch):
    monkeypatch.setattr("svsa.evaluation.tuning.cli.list_law_names", lambda: (LAW,))
    monkeypatch.setattr(tuned_law, "find_noise_limit", lambda: 1.0)
    common = ["tune", "--all", "--budget", "4", "--trials", "2", "--validation", "2"]
    common += ["--output", str(tmp_path)]
    CliRunner().invoke(app, common, catch_exceptions=False)
    (path,) = tmp_path.iterdir()
    found = TunedLaw.model_validate_json(path.read_bytes())
    assert (found.law, found.candidates, found.trials, found.validation) == (LAW, 4, 2, 2)
    assert found == build_tuned_law(tune(LAW, budget=4, **SHORT))
    path.write_bytes(path.read_bytes().replace(b'"cost":', b'"cost": ', 1))
    kept = path.read_bytes()
    CliRunner().invoke(app, common, catch_exceptions=False)
    assert path.read_bytes() == kept, "tuned again"
    CliRunner().invoke(app, [*common, "--seed", "1"], catch_exceptions=False)
    assert path.read_bytes() != kept


def test_tuned_laws_of_the_ranking_fit_the_installed_laws():
    """Files of one budget, seed and noise limit, for parameters that the laws still have."""
    tuned = load_tuned_laws()
    budgets = {(one.candidates, one.trials, one.validation, one.seed) for one in tuned.values()}
    assert len(budgets) == 1
    for one in tuned.values():
        one.build_design()
        assert one.noise_limit_nm_per_s == pytest.approx(find_noise_limit(), rel=1e-9)

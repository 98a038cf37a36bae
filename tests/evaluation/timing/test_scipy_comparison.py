"""scipy in `svsa benchmark`: the same problem, solved to the accuracy of the lab."""

import numpy as np
import pytest

import svsa
from svsa.evaluation.timing import plant_problem as problem
from svsa.evaluation.timing import scipy_comparison as comparison

DURATION_S = 0.2


@pytest.fixture(scope="module")
def posed() -> problem.Problem:
    return problem.build_problem(DURATION_S)


@pytest.fixture(scope="module")
def exact(posed: problem.Problem) -> np.ndarray:
    return comparison.solve_exactly(posed)


def test_problem_is_the_plant_of_the_run_bit_for_bit(posed: problem.Problem) -> None:
    samples = svsa.simulate("4a", "ndobc", duration_s=6.0).samples
    following = samples[posed.first + 1 : posed.first + len(posed.torques) + 1, problem.COLUMNS]
    assert np.array_equal(problem.solve(posed), following)
    middle = len(posed.forces) // 2
    assert np.array_equal(posed.forces[:middle, 1:], posed.torques[:middle])
    assert np.all(posed.forces[:middle, 0] == 0.0), "no load in the first half"
    assert np.all(posed.forces[middle:, 0] == 2.0), "the paper's in the second"
    assert np.all(posed.forces[middle:, 1:] == posed.torques[middle:] + 2.0)


def test_exact_solution_is_the_limit_of_smaller_steps(
    posed: problem.Problem, exact: np.ndarray
) -> None:
    """Of order 4: half the step has a sixteenth of the error. The exact solution is from another
    method.
    """
    errors = [comparison.compute_error(problem.solve(posed, steps), exact) for steps in (1, 2, 4)]
    assert 1e-9 < errors[0] < 1e-7
    assert 12.0 < errors[0] / errors[1] < 20.0
    assert 12.0 < errors[1] / errors[2] < 20.0


@pytest.mark.parametrize("method", comparison.METHODS)
def test_method_gets_its_loosest_tolerance_with_at_most_the_error_of_the_lab(
    posed: problem.Problem, exact: np.ndarray, method: str
) -> None:
    ours = comparison.compute_error(problem.solve(posed), exact) + comparison.ROUNDING_RAD
    found = comparison.find_tolerance(method, posed, exact, ours)
    assert found is not None
    assert found.error_rad == comparison.compute_error(found.solver(), exact)
    assert found.error_rad <= ours
    for tolerance in comparison.TOLERANCES:
        if found.setting == f"{method}: {tolerance:g}":
            break
        worse = comparison.solve_by_scipy(posed, method, tolerance, posed.period)
        assert comparison.compute_error(worse, exact) > ours


def test_method_without_sufficient_accuracy_is_excluded(
    posed: problem.Problem, exact: np.ndarray
) -> None:
    assert comparison.find_tolerance("LSODA", posed, exact, -1.0) is None


def test_scipy_is_reported_by_the_cheapest_of_its_methods(monkeypatch: pytest.MonkeyPatch) -> None:
    prices = {"svsa RK4: 1": 2e-3, "scipy RK45: 0.001": 8e-3, "scipy DOP853: 0.001": 6e-3}
    monkeypatch.setattr(
        comparison,
        "measure_in_turns",
        lambda works, _: {name: prices.get(name, 1.0) for name in works},
    )
    reported = comparison.compare_with_scipy(1, DURATION_S)
    assert list(reported) == ["svsa", "scipy"]
    assert reported["svsa"].ratio == 1.0
    assert reported["svsa"].cpu_us_per_period == pytest.approx(10.0)
    assert reported["scipy"].ratio == pytest.approx(3.0)
    assert reported["scipy"].setting == "DOP853: 0.001"
    assert 0.0 < reported["scipy"].error_rad <= reported["svsa"].error_rad

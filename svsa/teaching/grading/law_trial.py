"""Trial of a law before its submission: one run of a public scenario."""

from svsa.evaluation.metrics import HELD
from svsa.evaluation.ranking.scenarios import PUBLIC_SEED
from svsa.evaluation.ranking.test_set import build_test_trial
from svsa.teaching.grading.law_runs import LawRun, run_law
from svsa.teaching.isolation.confinement import Bounds, confine
from svsa.teaching.isolation.process import Place
from svsa.teaching.isolation.refusal import NotIsolatedError
from svsa.teaching.submission import LONGEST_OUTPUT, SavedLaw

BOUNDS = Bounds(cpu_s=20)
OPEN_TRIAL = 0


def try_law(text: str, place: Place = confine) -> SavedLaw:
    """Save a law and run it once on the first public trial, within 20 s of processor time.

    If the machine cannot isolate a law, it is not run, and the result contains the reason.
    """
    scenario = build_test_trial("A", PUBLIC_SEED, OPEN_TRIAL)
    try:
        run = run_law(text.encode(), scenario, BOUNDS, place)
    except NotIsolatedError as error:
        message = f"{error} At home svsa grade --practice tries it."
        return SavedLaw(text=text, verdict="untried", feedback=message)
    return judge_trial(text, run)


def judge_trial(text: str, run: LawRun) -> SavedLaw:
    """Describe the result of the trial run."""
    output = run.output[-LONGEST_OUTPUT:]
    if run.cost_us is None:
        return SavedLaw(text=text, verdict="failed", feedback=run.problem, output=output)
    cost = f"An answer takes {run.cost_us:.0f} µs."
    if run.rms_deg is None:
        message = f"{run.problem} {cost}"
        return SavedLaw(text=text, verdict="ended", feedback=message, output=output)
    rms = f"{run.rms_deg:.3g}° rms from the load on"
    if run.held:
        message = f"The run held: {HELD}; {rms}."
        return SavedLaw(text=text, verdict="held", feedback=f"{message} {cost}")
    message = f"The run reached its end with {rms}, but did not hold. Held: {HELD}."
    return SavedLaw(text=text, verdict="ran", feedback=f"{message} {cost}")

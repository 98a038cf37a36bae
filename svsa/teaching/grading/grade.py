"""A grade: points by criterion, computed from the submission only."""

from collections.abc import Callable
from pathlib import Path

from svsa.evaluation.trials import PROTOCOL, derive_seed
from svsa.hardware.session.replay import verify_bench_record
from svsa.inputs.checked import Checked, Flag, Number, quantity
from svsa.inputs.extras import __version__
from svsa.runs.records.catalogue.runs import Catalogue
from svsa.runs.records.header import RecordError
from svsa.runs.records.resimulation import compare_with_simulation, describe_not_compared
from svsa.runs.result.result import Result
from svsa.teaching.course.criterion import CriterionResult, Judgement
from svsa.teaching.course.exercise import Exercise
from svsa.teaching.course.judge import judge_submission
from svsa.teaching.course.run import open_course_run
from svsa.teaching.grading.law_points import judge_law, run_trials
from svsa.teaching.isolation.confinement import confine, leave_open
from svsa.teaching.submission import Submission, digest_law


class VerifiedRun(Checked):
    """A submitted run, and the result of simulating it again."""

    run_id: str = quantity("", "Id of the run")
    description: str = quantity("", "Result of the verification")


class Grade(Judgement):
    """The points of a submission, and the versions and trials of the grading.

    Attributes:
        submission: Digest of everything that was submitted.
        seed: Seed of the trials of its law, in hexadecimal, None without a law.
        is_isolated: False for a law that ran without isolation, which is not valid as a grade of a
            class.
    """

    student: str = quantity("", "Student")
    person: str = quantity("", "Id of the student: name of the submission's file", default="")
    submission: str = quantity("", "SHA-256 of the submission")
    max_points: Number = quantity("", "Maximum points", gt=0)
    runs: tuple[VerifiedRun, ...] = quantity("", "Verified runs", default=())
    seed: str | None = quantity("", "Seed of the trials", default=None)
    is_isolated: Flag = quantity("", "Whether the law ran in isolation", default=True)
    version: str = quantity("", "Version of the lab", default=__version__)


def verify_run(catalogue: Catalogue, run_id: str) -> VerifiedRun:
    """Verify that a recorded run follows bit for bit from its own configuration and commands.

    A simulated run is simulated again. For a bench's run everything but the measured and sent
    values is computed again, and the sent values are compared with its law.
    """
    record = catalogue.open(run_id)
    if record.header.plant != "simulated":
        return VerifiedRun(run_id=run_id, description=verify_bench_record(record).description)
    comparison = compare_with_simulation(record)
    if not comparison.identical:
        tick, channel = comparison.first_difference or (comparison.ticks, "")
        raise RecordError(
            f"Run {run_id} does not replay: simulated again, {channel} differs at tick {tick}."
        )
    description = f"Simulated again: its {comparison.ticks} samples are the same, bit for bit."
    description += describe_not_compared(comparison.not_compared)
    return VerifiedRun(run_id=run_id, description=description)


def grade(
    submission: Submission,
    exercise: Exercise,
    runs: Path | None,
    secret: bytes | None,
    report: Callable[[float], None] = lambda share: None,
) -> Grade:
    """Grade a submission.

    Args:
        submission: The submission.
        exercise: The exercise.
        runs: Folder of the runs; None for the data folder of this machine.
        secret: Secret of the class, which together with the law's text determines its trials, so
            that the same law gets the same points for every author. None for practice: public
            trials, and the law runs without isolation.
        report: Called with the finished share of the law's trials.

    Returns:
        The grade.

    Raises:
        ParameterError: If the submission does not fit the exercise.
        NotIsolatedError: If the machine cannot isolate a law.
    """
    catalogue, verified, law = Catalogue(runs), list[VerifiedRun](), submission.law
    seed = derive_seed(secret or b"practice", f"{PROTOCOL} {digest_law(law)}")

    def open_verified(run_id: str) -> Result:
        verified.append(verify_run(catalogue, run_id))
        return open_course_run(catalogue.find_folder(run_id))

    def judge_text(text: bytes | None) -> list[CriterionResult]:
        place = confine if secret else leave_open
        return judge_law(None if text is None else run_trials(text, seed, place, report))

    judged = judge_submission(exercise, submission, open_verified, judge_text)
    return Grade(
        **dict(judged),
        student=submission.student,
        submission=submission.digest,
        runs=tuple(verified),
        seed=None if law is None else f"{seed:016x}",
        is_isolated=law is None or secret is not None,
    )

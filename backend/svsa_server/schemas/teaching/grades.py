"""Requests and answers about grades."""

from pydantic import BaseModel, Field

from svsa.inputs.checked import Checked, Flag, quantity
from svsa.teaching.grading.class_grades import GradedSubmission
from svsa.teaching.grading.grade import Grade
from svsa_server.schemas.response import ResponseModel


class GradingRequest(Checked):
    """Which submissions to grade: those without a grade, or all."""

    again: Flag = quantity("", "Grade again submissions that already have a grade", default=False)


class GradedSubmissionState(ResponseModel):
    """A student's submission of an exercise."""

    exercise: str
    grade: Grade | None = Field(description="Grade; null if not graded yet")
    problem: str = Field(description="Why the latest grading failed, or empty")


class StudentState(BaseModel):
    """A student with their submissions."""

    person: str = Field(description="Id of the person")
    name: str
    submissions: list[GradedSubmissionState]


class GradedExercise(ResponseModel):
    """An exercise of the grade table."""

    name: str
    number: int
    title: str


class GradesState(BaseModel):
    """The grades of a class, students sorted by name."""

    not_isolated: str | None = Field(
        description="Why this machine cannot grade laws; null if it can"
    )
    exercises: list[GradedExercise]
    students: list[StudentState]


def describe_students(submitted: list[GradedSubmission]) -> list[StudentState]:
    """Group submissions by student, each under the name of the last submission."""
    students: dict[str, StudentState] = {}
    for submission in submitted:
        known = students.setdefault(
            submission.person,
            StudentState(person=submission.person, name=submission.student, submissions=[]),
        )
        known.submissions.append(GradedSubmissionState.model_validate(submission))
    return list(students.values())

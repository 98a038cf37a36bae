"""The runs that an exercise asks for, simulated once."""

from functools import cache

import svsa
from svsa.runs.result.result import Result
from svsa.teaching.course.exercise import Exercise
from svsa.teaching.course.file import list_exercise_files, read_exercise
from svsa.teaching.course.steps import Experiment


def find_exercise(name: str) -> Exercise:
    return next(read_exercise(path) for path in list_exercise_files() if path.stem == name)


@cache
def simulate_step(exercise: str, step: str) -> Result:
    found = find_exercise(exercise).find_step(step)
    assert isinstance(found, Experiment)
    return svsa.simulate(found.configuration, duration_s=found.duration_s)

"""The runs of the exercises, simulated once."""

from functools import cache

import svsa
from svsa.runs.result.result import Result
from svsa.teaching.course.exercise import Exercise
from svsa.teaching.course.file import list_exercise_files, read_exercise
from svsa.teaching.course.run import list_arm_lanes
from svsa.teaching.course.steps import Experiment


def find_exercise(name: str) -> Exercise:
    return next(read_exercise(path) for path in list_exercise_files() if path.stem == name)


@cache
def simulate_step(exercise: str, step: str) -> Result:
    found = find_exercise(exercise).find_step(step)
    assert isinstance(found, Experiment)
    if found.configuration.arm is not None:
        arm = svsa.simulate_arm(found.configuration, duration_s=found.duration_s)
        return list_arm_lanes(arm)
    return svsa.simulate(found.configuration, duration_s=found.duration_s)

"""The run of an experiment as a result with one lane for each controller, also of an arm."""

from pathlib import Path

import numpy as np

from svsa.runs.records.reader import open_record
from svsa.runs.result.arm import ArmResult
from svsa.runs.result.recorded import open_arm_run, open_run
from svsa.runs.result.result import Result, build_results


def open_course_run(folder: Path) -> Result:
    """Open a recorded run; raises as `open_run`."""
    if open_record(folder).header.is_arm:
        return list_arm_lanes(open_arm_run(folder))
    return open_run(folder)


def list_arm_lanes(run: ArmResult) -> Result:
    """Convert the result of an arm to one with a lane for each joint, as in a session.

    Args:
        run: The arm, and as its comparison a second one.

    Returns:
        Joint 1; its comparisons are the other joints, and all joints of the second arm.
    """
    samples = np.concatenate([arm.samples for arm in (run, *run.comparisons)])
    laws = [lane.law for lane in run.configuration.lanes]
    return build_results(run.configuration, samples, laws, run.fault, run.commands, steps=run.steps)

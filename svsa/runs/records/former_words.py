"""Translation of files from before a renaming.

Former names of a law's parameters are in the file of the law (`LawParameters.former_names`).

A record, or the progress of a student, keeps the names of its version. The reader translates them
once, so that all other code uses the current names only.
"""

import re
from typing import Any

from svsa.actuators.arm.parameters import read_former_field

FIELDS = {"rivals": "comparisons"}
"""Fields of a configuration."""
KINDS = {"controller": "law", "rivals": "comparisons"}
"""Kinds of commands."""
MOTION = {"made": "actual"}
"""Fields of a bench loop's state at the start of a run."""
PROGRESS = {"handed_in": "submitted_at"}
"""Fields of a student's progress in an exercise."""
STEPS = {"hand-in": "submit"}
"""Steps of the exercises of the package."""
SUBMISSIONS = "handed-in"
"""Folder of the submissions of a course."""
METRICS = {"settled_position_error_rad": "steady_state_position_error_rad"}
"""Metrics: columns and criteria of studies."""
SETTINGS = {"realism": "effects"}
"""Settings in the catalogue of runs."""
RESULTS = {"told": "description", "draws": "trials", "draws_held": "trials_held"}
"""Fields of grades and of entries of the leaderboard."""
SEARCHES = {"harm": "cost", "neighbors_hurt": "neighbors_failed"}
"""Fields of an adversary's file, and of the origin of a scenario."""
SCENARIOS = {"unloading": "load_removal", "draw_": "trial_", "unloading_": "load_removal_"}
"""Scenarios of the ranking, by the beginning of their names."""


def translate_fields(written: Any, words: dict[str, str]) -> Any:
    """Rename the fields of an object; return any other value unchanged.

    Args:
        written: A value read from JSON.
        words: Current name by former name.

    Returns:
        The object with the current names.
    """
    if not isinstance(written, dict):
        return written
    return {words.get(name, name): value for name, value in written.items()}


def translate_configuration(written: Any) -> Any:
    """Rename and complete the fields of a configuration; an arm had exactly one other joint.

    Args:
        written: A value read from JSON.

    Returns:
        The configuration with the current names.
    """
    present = translate_fields(written, FIELDS)
    arm = present.get("arm") if isinstance(present, dict) else None
    if not isinstance(arm, dict):
        return present
    arm = arm | {"adaptation": _translate_adaptation(arm.get("adaptation"))}
    if "joint2" in arm:
        joint = translate_configuration(arm["joint2"])
        others = {name: value for name, value in arm.items() if name != "joint2"}
        arm = others | {"other_joints": [joint]}
    return present | {"arm": arm}


def _translate_adaptation(written: Any) -> Any:
    """ŵ2 did not change with the nominal inertia in versions without the field."""
    return {"shifts_estimate": False} | written if isinstance(written, dict) else written


def translate_path(path: str) -> str:
    """Translate the path of a setting of an arm that had two joints and two links.

    Args:
        path: Path in a study or an exercise, such as "arm.joint2.stiffness".

    Returns:
        The path to the same setting now.
    """
    links, _, name = path.rpartition(".")
    if links in ("arm.links", "arm.model") and (former := read_former_field(name)):
        number, field = former
        return f"{links}.chain[{number}].{field}"
    return re.sub(r"^arm\.joint2\b", "arm.other_joints[0]", path)


def translate_results(written: Any) -> Any:
    """Rename the fields of a grade or a leaderboard entry, and the scenarios in it.

    Args:
        written: A value read from JSON.
    """
    if isinstance(written, list):
        return [translate_results(element) for element in written]
    if not isinstance(written, dict):
        return written
    present = {name: translate_results(field) for name, field in written.items()}
    if isinstance(scenario := present.get("scenario"), str):
        present["scenario"] = _translate_scenario(scenario)
    return translate_fields(present, RESULTS)


def _translate_scenario(name: str) -> str:
    kind, underscore, rest = name.partition("_")
    return SCENARIOS.get(kind + underscore, kind + underscore) + rest


def translate_command(command: dict[str, Any]) -> dict[str, Any]:
    """Rename the kind of a stored command, and complete its argument."""
    kind = command.get("kind")
    if kind == "adaptation":
        return command | {"argument": _translate_adaptation(command.get("argument"))}
    return command | {"kind": KINDS[kind]} if kind in KINDS else command

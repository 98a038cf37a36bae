"""Words of files written before a renaming: the only place that knows them.

A record, or the progress of a student, keeps the words of its time. The reader translates them
once, so that everything behind it knows the present words only.
"""

from typing import Any

FIELDS = {"rivals": "comparisons"}
"""Fields of a configuration."""
KINDS = {"controller": "law", "rivals": "comparisons"}
"""Kinds of commands."""
MOTION = {"made": "actual"}
"""What a bench's loop carried when a run began."""
PROGRESS = {"handed_in": "submitted_at"}
"""Fields of a student's progress in an exercise."""
STEPS = {"hand-in": "submit"}
"""Steps of the exercises of the package."""
SUBMISSIONS = "handed-in"
"""Folder of the submissions of a course."""


def translate_fields(written: Any, words: dict[str, str]) -> Any:
    """Rename the fields of an object; anything else is returned as it is.

    Args:
        written: A value read from JSON.
        words: The present word of each former one.
    """
    if not isinstance(written, dict):
        return written
    return {words.get(name, name): value for name, value in written.items()}


def translate_command(command: dict[str, Any]) -> dict[str, Any]:
    """Rename the kind of a command as it was written."""
    kind = command.get("kind")
    return command | {"kind": KINDS[kind]} if kind in KINDS else command

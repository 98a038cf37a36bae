"""What scripts call an axis of the bench, in the words of a message."""

AXIS_WORDS = {
    "link": "the link",
    "motor1": "motor 1",
    "motor2": "motor 2",
    "deflection": "the deflection",
}
"""What an axis is called in a message."""

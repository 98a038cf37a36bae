"""What a fault is called where there is room for a few words: a mark, an event, a banner."""

FAULT_LABELS = {
    "not_finite": "Not a finite number",
    "lever_end": "End of the spiral",
    "deflection_limit": "Deflection too large",
    "singular_decoupling": "Decoupling near singular",
    "quick_stop": "Quick stop",
    "stale_feedback": "Feedback too old",
    "missed_ticks": "Ticks missed",
    "drive_error": "Drive error",
    "drive_zeroed": "Drive restarted",
    "drive_silent": "Drive silent",
    "bus_error": "Bus error",
    "foreign_command": "Foreign command",
    "encoder_lost": "Encoder lost",
    "overspeed": "Too fast",
    "position_limit": "Beyond its end",
    "overload": "Motor overloaded",
    "implausible": "Implausible torque",
    "encoder_frozen": "Encoder frozen",
    "vibration": "Vibration",
    "supervisor_lost": "Supervisor lost",
    "bench_not_opened": "Bench not opened",
    "loop_late": "Control loop late",
    "loop_silent": "Control loop silent",
    "loop_lost": "Control loop lost",
    "loop_and_supervisor_lost": "Loop and supervisor lost",
}


def label_fault(code: str) -> str:
    """The words for a fault's code; one that has none is written with blanks."""
    return FAULT_LABELS.get(code) or code.replace("_", " ").capitalize()

"""JSON schemas of the messages in an MCAP file."""

from typing import Any

from svsa.runs.records.header import RecordHeader

_TIMESTAMP: dict[str, Any] = {
    "type": "object",
    "title": "time",
    "properties": {
        "sec": {"type": "integer", "minimum": 0},
        "nsec": {"type": "integer", "minimum": 0, "maximum": 999_999_999},
    },
}

JOINT_STATES: dict[str, Any] = {
    "title": "foxglove.JointStates",
    "type": "object",
    "properties": {
        "timestamp": _TIMESTAMP,
        "joints": {
            "type": "array",
            "items": {
                "title": "foxglove.JointState",
                "type": "object",
                "properties": {
                    "name": {"type": "string"},
                    "position": {"type": "number", "description": "rad"},
                    "velocity": {"type": "number", "description": "rad/s"},
                    "effort": {"type": "number", "description": "N·m"},
                },
                "required": ["name"],
            },
        },
    },
    "required": ["timestamp", "joints"],
}

COMMAND: dict[str, Any] = {
    "title": "svsa.Command",
    "type": "object",
    "properties": {"tick": {"type": "integer"}, "command": {"type": "object"}},
    "required": ["tick", "command"],
}

EVENT: dict[str, Any] = {
    "title": "svsa.Event",
    "type": "object",
    "properties": {
        "tick": {"type": "integer"},
        "time_s": {"type": "number"},
        "kind": {"type": "string"},
        "label": {"type": "string"},
    },
    "required": ["tick", "time_s", "kind", "label"],
}


def build_sample_schema(header: RecordHeader) -> dict[str, Any]:
    """Build the schema of a sample: every channel with label and unit; null if not finite."""
    channels = {
        channel.name: {
            "type": ["number", "null"],
            "description": f"{channel.label} [{channel.unit}]",
        }
        for channel in header.channels
    }
    return {
        "title": "svsa.Sample",
        "type": "object",
        "properties": {"timestamp": _TIMESTAMP, "tick": {"type": "integer"}, **channels},
        "required": ["timestamp", "tick"],
    }

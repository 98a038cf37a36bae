"""How far a drive is on its way from off to READY."""

from enum import StrEnum


class Phase(StrEnum):
    """How far the sequence is."""

    OFF = "off"
    RESET = "reset"
    CONFIG = "config"
    MODE = "mode"
    READY = "ready"
    SILENT = "silent"

"""Progress of a drive from off to READY."""

from enum import StrEnum


class Phase(StrEnum):
    """The phase of the start-up."""

    OFF = "off"
    RESET = "reset"
    CONFIG = "config"
    MODE = "mode"
    READY = "ready"
    SILENT = "silent"

"""Installed optional dependencies, and the installed release."""

import sys
from importlib.metadata import PackageNotFoundError, version
from importlib.util import find_spec
from typing import Literal

from svsa.errors import SvsaError

DISTRIBUTION = "svsa-lab"
Extra = Literal[
    "server", "client", "bench", "plot", "nidaqmx", "pandas", "xarray", "cluster", "lti", "gym"
]
MODULES: dict[Extra, tuple[str, ...]] = {
    "server": (
        *("fastapi", "pydantic_settings", "uvicorn", "websockets", "httpx"),
        *("viser", "trimesh", "zstandard", "prometheus_client", "pythonjsonlogger"),
    ),
    "client": ("httpx", "websockets"),
    "bench": ("can", "serial", "cantools"),
    "plot": ("matplotlib",),
    "nidaqmx": ("nidaqmx",),
    "pandas": ("pandas",),
    "xarray": ("xarray",),
    "cluster": ("distributed",),
    "lti": ("joserfc",),
    "gym": ("gymnasium",),
}


class MissingExtraError(SvsaError, ImportError):
    """A package of an extra is missing; the message names the extra to install."""


def list_missing(extra: Extra) -> list[str]:
    """List the missing packages of an extra."""
    return [module for module in MODULES[extra] if not _is_there(module)]


def require_extra(extra: Extra) -> None:
    """Raise `MissingExtraError` if a package of an extra is missing."""
    if missing := list_missing(extra):
        raise MissingExtraError(
            f"This needs {', '.join(missing)}, which is not installed:"
            f" run `pip install '{DISTRIBUTION}[{extra}]'`.",
            name=missing[0],
        )


def _is_there(module: str) -> bool:
    return sys.modules.get(module) is not None or find_spec(module) is not None


try:
    __version__ = version(DISTRIBUTION)
except PackageNotFoundError:
    __version__ = "0+uninstalled"

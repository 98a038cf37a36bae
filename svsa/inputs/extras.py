"""The parts of the package that are installed only where they are wanted.

The base install is the library. What serves the lab, speaks to a bench or draws pictures needs
the packages of an extra; without them the call that needs one says which.
"""

import sys
from importlib.util import find_spec
from typing import Literal

from svsa.errors import SvsaError

DISTRIBUTION = "svsa-lab"
Extra = Literal["server", "client", "bench", "plot", "nidaqmx", "xarray", "cluster", "lti", "peers"]
MODULES: dict[Extra, tuple[str, ...]] = {
    "server": (
        *("fastapi", "pydantic_settings", "uvicorn", "websockets", "httpx"),
        *("viser", "trimesh", "zstandard"),
    ),
    "client": ("httpx", "websockets"),
    "bench": ("can", "serial", "cantools"),
    "plot": ("matplotlib",),
    "nidaqmx": ("nidaqmx",),
    "xarray": ("xarray",),
    "cluster": ("distributed",),
    "lti": ("joserfc",),
    "peers": ("casadi", "mujoco"),
}


class MissingExtraError(SvsaError, ImportError):
    """A package is missing that comes with an extra; the message says how to install it."""


def list_missing(extra: Extra) -> list[str]:
    """The packages of this extra that are not installed."""
    return [module for module in MODULES[extra] if not _is_there(module)]


def require_extra(extra: Extra) -> None:
    """Raise `MissingExtraError` where a package of this extra is not installed."""
    if missing := list_missing(extra):
        raise MissingExtraError(
            f"This needs {', '.join(missing)}, which is not installed:"
            f" run `pip install '{DISTRIBUTION}[{extra}]'`.",
            name=missing[0],
        )


def _is_there(module: str) -> bool:
    return sys.modules.get(module) is not None or find_spec(module) is not None

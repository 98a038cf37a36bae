"""pyarrow, imported at its first use: it takes 34 MB, and a lab without records does not need it.

Modules that use it postpone the evaluation of annotations.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pyarrow import *  # noqa: F403  # pyright: ignore[reportWildcardImportFromLibrary]
    from pyarrow import compute as compute
    from pyarrow import csv as csv
    from pyarrow import ipc as ipc
    from pyarrow import parquet as parquet
    from pyarrow import types as types

_MODULES = {"compute", "csv", "ipc", "parquet"}


def __getattr__(name: str) -> Any:
    """Return what pyarrow has under this name."""
    if name.startswith("__"):
        raise AttributeError(name)
    if name in _MODULES:
        return import_module(f"pyarrow.{name}")
    return getattr(import_module("pyarrow"), name)

"""The folder in which the lab keeps its data."""

import os
from pathlib import Path

from svsa.errors import StateError

DATA_VARIABLE = "SVSA_DATA"


def find_data_folder() -> Path:
    """Return the folder of the data: SVSA_DATA, or .local/share/svsa in the user's home.

    Raises:
        StateError: If this needs a home folder, and the user has none.
    """
    setting = os.environ.get(DATA_VARIABLE)
    try:
        return Path(setting).expanduser() if setting else Path.home() / ".local" / "share" / "svsa"
    except RuntimeError:
        raise StateError(
            "The data folder is unknown, since this user has no home folder: set"
            f" {DATA_VARIABLE} to an absolute path."
        ) from None

"""The folder in which the lab keeps its data."""

import os
from pathlib import Path

DATA_VARIABLE = "SVSA_DATA"


def find_data_folder() -> Path:
    """Return the folder of the data: SVSA_DATA, or .local/share/svsa in the user's home."""
    given = os.environ.get(DATA_VARIABLE)
    return Path(given).expanduser() if given else Path.home() / ".local" / "share" / "svsa"

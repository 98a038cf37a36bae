"""The readable parts of a damaged record."""

import contextlib
from pathlib import Path

from svsa.runs.records.header import PARQUET_FILE, check_files, read_header
from svsa.runs.records.parquet import read_commands
from svsa.runs.records.reader import count_readable_rows


def describe_readable(folder: Path) -> str:
    """Describe the readable parts of a damaged record in one sentence.

    Args:
        folder: The record's folder.
    """
    parts: list[str] = []
    period_s, rows = None, 0
    # Any exception: each part may be damaged in any way.
    with contextlib.suppress(Exception):
        period_s = read_header(folder).period_s
        parts.append("settings")
    with contextlib.suppress(Exception):
        check_files(folder)
        count = len(read_commands(folder)[0])
        parts.append(f"{count} command{'' if count == 1 else 's'}")
        if (folder / PARQUET_FILE).exists():
            rows = count_readable_rows(folder)
    if rows:
        length = f"{rows} samples" if period_s is None else f"{rows * period_s:.6g} s"
        parts.append(f"the first {length}")
    return f"Still readable: {', '.join(parts)}." if parts else "Nothing of it can be read."

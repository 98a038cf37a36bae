"""The readable parts of a damaged record."""

from pathlib import Path

from svsa.runs.records.header import PARQUET_FILE, RecordError, read_header
from svsa.runs.records.parquet import read_commands
from svsa.runs.records.reader import count_readable_rows


def describe_readable(folder: Path) -> str:
    """Describe the readable parts of a damaged record in one sentence.

    Args:
        folder: The record's folder.
    """
    parts: list[str] = []
    period_s = None
    try:
        period_s = read_header(folder).period_s
        parts.append("settings")
    except (RecordError, OSError):
        pass
    try:
        count = len(read_commands(folder)[0])
        parts.append(f"{count} command{'' if count == 1 else 's'}")
    except (RecordError, OSError):
        pass
    rows = count_readable_rows(folder) if (folder / PARQUET_FILE).exists() else 0
    if rows:
        length = f"{rows} samples" if period_s is None else f"{rows * period_s:.6g} s"
        parts.append(f"the first {length}")
    return f"Still readable: {', '.join(parts)}." if parts else "Nothing of it can be read."

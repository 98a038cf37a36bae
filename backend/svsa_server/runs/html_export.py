"""The export of a run as a page, found by its entry point `svsa.exports`."""

from typing import IO

from svsa.inputs.extras import require_extra
from svsa.runs.records.export.formats import ExportKind
from svsa.runs.records.reader import Record


def write_html(record: Record, stream: IO[bytes]) -> None:
    """Write a record as one page with 3D replay and plots.

    Raises:
        MissingExtraError: Without the extra `server`.
        ReplayError: If the page was not built.
    """
    require_extra("server")
    from svsa_server.runs.replay_export import build_replay

    stream.write(build_replay(record).encode())


HTML = ExportKind("html", "text/html", write_html)

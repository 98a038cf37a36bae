"""The files of jobs in the data folder: after a restart of the server, jobs are still listed.

Each job has a folder, into which its worker writes, with a file that describes the job. A job that
had not ended when the server ended is listed as interrupted.
"""

import json
import logging
import shutil
import tempfile
from contextlib import ExitStack
from pathlib import Path
from typing import Any

from pydantic import TypeAdapter

from svsa.evaluation.studies.stored import StoredStudy
from svsa.inputs.file_lock import try_lock
from svsa.inputs.stored_file import read_json
from svsa.runs.records.header import replace_file
from svsa_server.jobs import falsifications, tunings
from svsa_server.jobs.progress import STOP, read_progress

LOCK, FILE = "lock", "job.json"
TASKS: dict[str, Any] = {
    "tuning": tunings.Task,
    "falsification": falsifications.Task,
    "study": StoredStudy,
}
"""Tasks that describe a result. Other kinds have results of their own, without the task."""
_NEXT = {
    "tuning": "its finished candidates are saved. Start it again with the same settings to continue"
    " it.",
    "falsification": "its runs and the worst case are saved. Start it again with the same settings"
    " to continue it.",
    "study": "its finished rows are saved. Start the study of this name again to continue it.",
    "submission": "laws that were measured have their entries. Submit the law, or start the"
    " measurement, again.",
    "grading": "finished grades are saved. Start the grading again for the others.",
}
_log = logging.getLogger("svsa")


class JobFolders:
    """The folders of the jobs of this server. `saved`: descriptions of earlier jobs, by time.

    Only one server stores its jobs in `path`; a second one uses a temporary folder, as without
    `path`.
    """

    def __init__(self, path: Path | None) -> None:
        self._open = ExitStack()
        self.saved: list[dict[str, Any]] = []
        if path is not None and self._is_claimed(path):
            self.path = path
            read = [_read(folder) for folder in path.iterdir() if folder.is_dir()]
            self.saved = sorted(filter(None, read), key=lambda job: job["created"])
        else:
            place = tempfile.TemporaryDirectory(prefix="svsa-", ignore_cleanup_errors=True)
            self.path = Path(self._open.enter_context(place))

    def _is_claimed(self, path: Path) -> bool:
        """Claim a folder; return False if another server has it, or it cannot be used."""
        try:
            path.mkdir(parents=True, exist_ok=True)
            return try_lock(self._open.enter_context((path / LOCK).open("wb")).fileno())
        except OSError as error:
            _log.warning("Jobs are not kept after this server, because of %s", error)
            return False

    def close(self) -> None:
        """Leave the folder to another server."""
        self._open.close()


def write_job(folder: Path, fields: dict[str, Any], task: Any) -> None:
    """Write the description of a job.

    Raises:
        OSError: If it cannot be written.
    """
    kind = TASKS.get(fields["kind"])
    written = None
    if kind is not None and isinstance(task, kind):
        written = TypeAdapter(kind).dump_python(task, mode="json", serialize_as_any=True)
    content = json.dumps(fields | {"task": written}).encode()
    replace_file(folder / FILE, content)


def remove_job(folder: Path) -> None:
    """Remove the files of a job."""
    shutil.rmtree(folder, ignore_errors=True)


def _read(folder: Path) -> dict[str, Any] | None:
    """Return the description of an earlier job; None if its file is missing or damaged."""
    if not (folder / FILE).exists():
        # The server was killed before the job had begun.
        remove_job(folder)
        return None
    try:
        fields = read_json(folder / FILE)
        if not all(isinstance(fields[name], str) for name in _TEXTS) or fields["kind"] not in _NEXT:
            raise ValueError("a field is wrong")
        if fields["problem"] is not None:
            fields["problem"] = str(fields["problem"])
        if fields["kind"] in TASKS:
            fields["task"] = TypeAdapter(TASKS[fields["kind"]]).validate_python(fields["task"])
    except Exception as error:
        _log.warning("The job in %s is not listed, because its file is damaged: %s", folder, error)
        return None
    if fields["status"] in ("waiting", "running") and (folder / STOP).exists():
        fields["status"] = "cancelled"
    elif fields["status"] in ("waiting", "running"):
        done, total, _ = read_progress(folder)
        state = f"after {done} of {total}" if total else "before it had results"
        fields["status"] = "interrupted"
        fields["problem"] = f"The server ended {state}; {_NEXT[fields['kind']]}"
    return fields | {"id": folder.name}


_TEXTS = ("kind", "title", "owner", "created", "status")

"""The saved studies: each has a folder with its definition and its rows (see `rows`)."""

import json
import re
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import UTC, datetime
from pathlib import Path
from typing import Any
from uuid import uuid4

from svsa.errors import ParameterError, Violation
from svsa.evaluation.studies.rows import PARTS, find_missing
from svsa.evaluation.studies.stored import EXAMPLES, StoredStudy, StudyError
from svsa.evaluation.studies.study import Study
from svsa.inputs.data_folder import find_data_folder
from svsa.inputs.extras import __version__
from svsa.inputs.file_lock import try_lock
from svsa.inputs.stored_file import read_json
from svsa.runs.records.former_words import METRICS, translate_fields
from svsa.runs.records.header import replace_file

STUDY_FILE, LOCK_FILE = "study.json", "lock"
EXAMPLE = "load-example"
"""A finished study in the package: `make examples` computes it."""
_NAME = re.compile(r"[0-9A-Za-z][0-9A-Za-z_.-]{0,63}", re.ASCII)


def check_name(name: str) -> None:
    """Raise `ParameterError` for an invalid name."""
    if not _NAME.fullmatch(name):
        bound = "1 to 64 letters, digits, -, _ or .; the first one a letter or digit"
        raise ParameterError(Violation("name", name, "", bound))


def find_studies_folder() -> Path:
    """Return the folder of the studies, next to that of the runs."""
    return find_data_folder() / "studies"


def prepare_study(
    name: str, study: Study, root: Path | None = None, owner: str = ""
) -> StoredStudy:
    """Return what `keep_study` would save, and raise its errors, except those of the disk."""
    check_name(name)
    folder = (root or find_studies_folder()) / name
    created = datetime.now(UTC).isoformat(timespec="seconds")
    if not is_kept(name, root):
        return StoredStudy(name, study, folder, created, __version__, owner)
    kept = open_study(name, root)
    if kept.study.changed(runs=study.runs) != study:
        raise StudyError(
            f"Study {name} is another one: it was started with other settings. Use another"
            f" name (--name), or delete {folder}."
        )
    if study.runs > kept.study.runs:
        kept = kept._replace(study=study)
    if kept.version != __version__ and find_missing(kept):
        raise StudyError(
            f"Study {name} was started by version {kept.version} of svsa, and this is"
            f" {__version__}: its runs might differ. Use another name (--name)."
        )
    return kept


def keep_study(name: str, study: Study, root: Path | None = None, owner: str = "") -> StoredStudy:
    """Save a new study, or continue one, possibly with more runs.

    `owner` is that of a new study; an existing one keeps its owner.

    Raises:
        ParameterError: If the name is invalid.
        StudyError: If another study has the name.
    """
    stored = prepare_study(name, study, root, owner)
    text = {field: getattr(stored, field) for field in ("name", "created", "version", "owner")}
    content = json.dumps(text | {"study": stored.study.model_dump(mode="json")}, indent=1)
    try:
        (stored.folder / PARTS).mkdir(parents=True, exist_ok=True)
        replace_file(stored.folder / STUDY_FILE, content.encode())
    except OSError as error:
        raise StudyError(f"Study {name} cannot be saved in {stored.folder}: {error}.") from None
    return stored


def is_kept(name: str, root: Path | None = None) -> bool:
    """Whether a study of this name exists."""
    is_name = _NAME.fullmatch(name) is not None
    return is_name and ((root or find_studies_folder()) / name / STUDY_FILE).exists()


def find_root(name: str) -> Path:
    """Find the folder that contains a study: a saved one, or the example in the package."""
    is_saved = name != EXAMPLE or is_kept(name)
    return find_studies_folder() if is_saved else EXAMPLES


def open_study(name: str, root: Path | None = None) -> StoredStudy:
    """Open a study.

    Raises:
        StudyError: If it does not exist or is unreadable.
    """
    root = root or find_root(name)
    folder = root / name
    try:
        written = read_json(folder / STUDY_FILE)
        study = Study(**_translate_definition(written["study"]))
        origin = written["created"], written["version"], written.get("owner", "")
        return StoredStudy(name, study, folder, *origin)
    except FileNotFoundError:
        known = ", ".join(saved.name for saved in list_studies(root)) or "none"
        raise StudyError(f"There is no study {name} in {root}; there: {known}.") from None
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise StudyError(f"Study {name} cannot be read: {error}") from None


def _translate_definition(written: dict[str, Any]) -> dict[str, Any]:
    """Translate metrics of an earlier version to the current names."""
    present = dict(written)
    if "success" in present:
        present["success"] = translate_fields(present["success"], METRICS)
    if "metrics" in present:
        present["metrics"] = [METRICS.get(name, name) for name in present["metrics"]]
    return present


def read_owner(name: str, root: Path | None = None) -> str | None:
    """Return the id of a study's owner, without building the study.

    Args:
        name: Name of the study.
        root: Folder of the studies; by default `find_studies_folder`.

    Returns:
        The id, empty outside a class; None if there is no such study, or it cannot be read.
    """
    if not _NAME.fullmatch(name):
        return None
    try:
        written = read_json((root or find_root(name)) / name / STUDY_FILE)
    except (OSError, ValueError):
        return None
    owner = written.get("owner", "") if isinstance(written, dict) else None
    return owner if isinstance(owner, str) else None


def list_studies(root: Path | None = None) -> list[StoredStudy]:
    """List the saved studies that are readable, by name."""
    root = root or find_studies_folder()
    studies = []
    for path in sorted(root.glob(f"*/{STUDY_FILE}")):
        try:
            studies.append(open_study(path.parent.name, root))
        except StudyError:
            continue
    return studies


def measure_bytes(owner: str, root: Path | None = None) -> int:
    """Compute the disk space of one owner's studies, bytes."""
    folders = [stored.folder for stored in list_studies(root) if stored.owner == owner]
    files = (path for folder in folders for path in folder.rglob("*"))
    return sum(path.stat().st_size for path in files if path.is_file())


@contextmanager
def claim_study(stored: StoredStudy) -> Iterator[None]:
    """Lock a study.

    Raises:
        StudyError: If another process runs it.
    """
    with (stored.folder / LOCK_FILE).open("wb") as file:
        if not try_lock(file.fileno()):
            raise StudyError(f"Study {stored.name} is being run by another process.")
        yield


def delete_study(stored: StoredStudy) -> None:
    """Delete a study with all its rows.

    Raises:
        StudyError: If a process runs it.
    """
    if stored.is_example:
        raise StudyError(f"Study {stored.name} is part of the package and cannot be deleted.")
    gone = stored.folder.with_name(f".{uuid4().hex}")
    try:
        with claim_study(stored):
            stored.folder.rename(gone)
        (gone / STUDY_FILE).unlink()
        shutil.rmtree(gone)
    except OSError as error:
        raise StudyError(f"Study {stored.name} cannot be deleted: {error}.") from None

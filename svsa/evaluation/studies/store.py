"""Storage of a study: its text, the finished parts, and one table of all parts.

A part is a file that is there as a whole or not at all. What is done is what is there: so a study
goes on where it was left, however it was left, with parts of any size.
"""

import json
import re
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, NamedTuple
from uuid import uuid4

import pyarrow as pa
import pyarrow.parquet as pq

from svsa.errors import ParameterError, SvsaError, Violation
from svsa.evaluation.studies.study import Study
from svsa.evaluation.studies.work import build_schema, list_repeating
from svsa.inputs.extras import __version__
from svsa.inputs.file_lock import try_lock
from svsa.runs.records.catalogue.runs import find_data_folder
from svsa.runs.records.former_words import METRICS, translate_fields
from svsa.runs.records.header import replace_file

STUDY_FILE, TABLE_FILE, PARTS, LOCK_FILE = "study.json", "rows.parquet", "parts", "lock"
ROWS_A_GROUP = 65_536
_PART = re.compile(r"(\d+)-(\d+)\.parquet")
_NAME = re.compile(r"[0-9A-Za-z][0-9A-Za-z_.-]{0,63}", re.ASCII)

Span = tuple[int, int]
"""The samples from the first to before the second number."""


class StudyError(SvsaError):
    """A study that cannot be saved, read or continued; finished parts stay."""


class StoredStudy(NamedTuple):
    """A study and its folder. owner: id of the person who started it, in a class; else empty."""

    name: str
    study: Study
    folder: Path
    created: str
    version: str
    owner: str = ""


def check_name(name: str) -> None:
    """Raise `ParameterError` for an invalid name."""
    if not _NAME.fullmatch(name):
        bound = "1 to 64 letters, digits, -, _ or ., the first no sign"
        raise ParameterError(Violation("name", name, "", bound))


def find_studies_folder() -> Path:
    """Return the folder of the studies, next to that of the runs."""
    return find_data_folder() / "studies"


def keep_study(name: str, study: Study, root: Path | None = None, owner: str = "") -> StoredStudy:
    """Save a new study, or continue one, possibly with more runs.

    owner: of one that is begun; one that is gone on with keeps its own.

    Raises `ParameterError` for a name that is none, `StudyError` where another study has it.
    """
    check_name(name)
    folder = (root or find_studies_folder()) / name
    created, version = datetime.now(UTC).isoformat(timespec="seconds"), __version__
    if is_kept(name, root):
        kept = open_study(name, root)
        if kept.study.changed(runs=study.runs) != study:
            raise StudyError(
                f"Study {name} is another one: it was begun with other settings. Give yours"
                f" another name (--name), or delete {folder}."
            )
        if study.runs <= kept.study.runs:
            study = kept.study
        if kept.version != __version__ and find_missing(kept._replace(study=study)):
            raise StudyError(
                f"Study {name} was begun by version {kept.version} of svsa, and this is"
                f" {__version__}: its runs might differ. Give this one another name (--name)."
            )
        created, version, owner = kept.created, kept.version, kept.owner
    text = {"name": name, "created": created, "version": version, "owner": owner}
    content = json.dumps(text | {"study": study.model_dump(mode="json")}, indent=1)
    try:
        (folder / PARTS).mkdir(parents=True, exist_ok=True)
        replace_file(folder / STUDY_FILE, content.encode())
    except OSError as error:
        raise StudyError(f"Study {name} cannot be kept in {folder}: {error}.") from None
    return StoredStudy(name, study, folder, created, version, owner)


def is_kept(name: str, root: Path | None = None) -> bool:
    """Whether a study of this name exists."""
    is_name = _NAME.fullmatch(name) is not None
    return is_name and ((root or find_studies_folder()) / name / STUDY_FILE).exists()


def open_study(name: str, root: Path | None = None) -> StoredStudy:
    """Open a study; raises `StudyError` if it does not exist or is unreadable."""
    root = root or find_studies_folder()
    folder = root / name
    try:
        written = json.loads((folder / STUDY_FILE).read_text(encoding="utf-8"))
        study = Study(**_translate_definition(written["study"]))
        reported = written["created"], written["version"], written.get("owner", "")
        return StoredStudy(name, study, folder, *reported)
    except FileNotFoundError:
        known = ", ".join(one.name for one in list_studies(root)) or "none"
        raise StudyError(f"There is no study {name} in {root}; there: {known}.") from None
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise StudyError(f"Study {name} cannot be read: {error}") from None


def _translate_definition(written: dict[str, Any]) -> dict[str, Any]:
    """Translate metrics of an earlier version to the present names."""
    present = dict(written)
    if "success" in present:
        present["success"] = translate_fields(present["success"], METRICS)
    if "metrics" in present:
        present["metrics"] = [METRICS.get(name, name) for name in present["metrics"]]
    return present


def read_owner(name: str, root: Path | None = None) -> str | None:
    """Return the id of a study's owner, without building the study.

    Args:
        name: Of the study.
        root: Folder of the studies; `find_studies_folder` if left out.

    Returns:
        The id, empty outside a class; None if there is no such study, or it cannot be read.
    """
    if not _NAME.fullmatch(name):
        return None
    try:
        written = json.loads(((root or find_studies_folder()) / name / STUDY_FILE).read_bytes())
    except (OSError, ValueError):
        return None
    owner = written.get("owner", "") if isinstance(written, dict) else None
    return owner if isinstance(owner, str) else None


def list_studies(root: Path | None = None) -> list[StoredStudy]:
    """List the saved studies that are readable, by name."""
    root = root or find_studies_folder()
    found = []
    for path in sorted(root.glob(f"*/{STUDY_FILE}")):
        try:
            found.append(open_study(path.parent.name, root))
        except StudyError:
            continue
    return found


def measure_bytes(owner: str, root: Path | None = None) -> int:
    """Compute the disk space of one owner's studies, bytes."""
    folders = [one.folder for one in list_studies(root) if one.owner == owner]
    files = (path for folder in folders for path in folder.rglob("*"))
    return sum(path.stat().st_size for path in files if path.is_file())


@contextmanager
def claim_study(stored: StoredStudy) -> Iterator[None]:
    """Lock a study; raises `StudyError` if another process runs it."""
    with (stored.folder / LOCK_FILE).open("wb") as file:
        if not try_lock(file.fileno()):
            raise StudyError(f"Study {stored.name} is being run by another process.")
        yield


def delete_study(stored: StoredStudy) -> None:
    """Delete a study with all its rows; raises `StudyError` if a process runs it."""
    gone = stored.folder.with_name(f".{uuid4().hex}")
    try:
        with claim_study(stored):
            stored.folder.rename(gone)
        (gone / STUDY_FILE).unlink()
        shutil.rmtree(gone)
    except OSError as error:
        raise StudyError(f"Study {stored.name} cannot be deleted: {error}.") from None


def write_part(stored: StoredStudy, span: Span, content: bytes) -> None:
    """Save the rows of these samples in a Parquet file."""
    replace_file(stored.folder / PARTS / f"{span[0]:010d}-{span[1]:010d}.parquet", content)


def list_parts(stored: StoredStudy) -> list[tuple[Span, Path]]:
    """List the files with rows, each with its samples, in order, without overlaps."""
    parts: list[tuple[Span, Path]] = []
    table = stored.folder / TABLE_FILE
    if table.exists():
        rows = pq.read_metadata(table).num_rows
        parts.append(((0, rows // len(stored.study.laws)), table))
    for path in sorted((stored.folder / PARTS).glob("*.parquet")):
        if found := _PART.fullmatch(path.name):
            span = int(found[1]), int(found[2])
            if not parts or span[0] >= parts[-1][0][1]:
                parts.append((span, path))
    return parts


def find_missing(stored: StoredStudy) -> list[Span]:
    """Find the spans of samples that are not finished."""
    missing: list[Span] = []
    reached = 0
    for (first, stop), _ in list_parts(stored):
        if first > reached:
            missing.append((reached, first))
        reached = stop
    if reached < stored.study.sample_count:
        missing.append((reached, stored.study.sample_count))
    return missing


def count_done(stored: StoredStudy) -> int:
    """Count the finished samples."""
    return sum(stop - first for (first, stop), _ in list_parts(stored))


def join_parts(stored: StoredStudy) -> Path | None:
    """Join the rows from the first sample on in one table; return its path, None without rows.

    In the order of the rows, and in groups of one size: neither the order in which parts came nor
    their sizes show.
    """
    whole = []
    reached = 0
    for (first, stop), path in list_parts(stored):
        if first == reached:
            whole.append(path)
            reached = stop
    table = stored.folder / TABLE_FILE
    if not whole or whole == [table]:
        return table if whole else None
    draft = table.with_suffix(".tmp")
    schema = build_schema(stored.study)
    with pq.ParquetWriter(draft, schema, use_dictionary=list_repeating(schema)) as writer:
        for group in _regroup(whole):
            writer.write_table(group, row_group_size=ROWS_A_GROUP)
    draft.replace(table)
    for path in whole:
        if path != table:
            path.unlink(missing_ok=True)
    return table


def _regroup(paths: list[Path]) -> Iterator[pa.Table]:
    """Regroup the rows in tables of `ROWS_A_GROUP`, the last one shorter."""
    waiting: list[pa.Table] = []
    for path in paths:
        with pq.ParquetFile(path) as file:
            for number in range(file.num_row_groups):
                waiting.append(_translate(file.read_row_group(number)))
                while sum(map(len, waiting)) >= ROWS_A_GROUP:
                    joined = pa.concat_tables(waiting)
                    yield joined.slice(0, ROWS_A_GROUP)
                    waiting = [joined.slice(ROWS_A_GROUP)]
    if sum(map(len, waiting)):
        yield pa.concat_tables(waiting)


def _read_part(path: Path, columns: list[str] | None) -> pa.Table:
    if columns is not None:
        former = {present: name for name, present in METRICS.items()}
        there = pq.read_schema(path).names
        columns = [one if one in there else former.get(one, one) for one in columns]
    return _translate(pq.read_table(path, columns=columns))


def _translate(table: pa.Table) -> pa.Table:
    """Translate columns of an earlier version to the present names."""
    return table.rename_columns([METRICS.get(name, name) for name in table.column_names])


def read_rows(stored: StoredStudy, columns: list[str] | None = None) -> pa.Table:
    """Read some or all columns of the finished rows; raises `StudyError` without rows."""
    tables = [_read_part(path, columns) for _, path in list_parts(stored)]
    if not tables:
        raise StudyError(f"Of study {stored.name} nothing is done: `svsa study run` it first.")
    return pa.concat_tables(tables)

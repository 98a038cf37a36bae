"""Back up and restore the data folder: recordings, studies, class and grades, in one archive."""

import contextlib
import io
import json
import os
import sqlite3
import tarfile
import tempfile
from datetime import UTC, datetime
from pathlib import Path

from svsa.errors import StateError, SvsaError
from svsa.inputs.extras import __version__
from svsa.inputs.stored_file import load_json

MANIFEST = "svsa-backup.json"
FORMAT = 1
_DATABASE = ".sqlite"
_LEFT_OUT = ("server.lock", "*.sqlite-wal", "*.sqlite-shm", "*.sqlite-journal", "*.tmp", "*.part")


class BackupError(SvsaError):
    """An archive cannot be written or restored."""


def back_up(folder: Path, archive: Path) -> int:
    """Write all files of a data folder to an archive; the lab may run and record at the same time.

    SQLite copies the databases, so that changes during the copy are safe. A run that is being
    recorded is in the archive with its current samples; the restored lab lists it as interrupted.

    Args:
        folder: The data folder.
        archive: File to write (.tar.gz). It is complete or does not exist.

    Returns:
        Number of files in the archive.

    Raises:
        BackupError: If the folder is missing, or the archive exists, is inside the folder or cannot
            be written.
    """
    if not folder.is_dir():
        raise BackupError(f"There is no data folder {folder}: set SVSA_DATA to the lab's folder.")
    if archive.exists():
        raise BackupError(f"{archive} exists: choose another file, or delete it.")
    if archive.resolve().is_relative_to(folder.resolve()):
        raise BackupError(f"{archive} is inside the data folder: choose a file outside {folder}.")
    unfinished = archive.with_name(archive.name + ".part")
    try:
        # Readable by this account only: the archive contains the secrets of class and gradebook.
        with (
            os.fdopen(os.open(unfinished, os.O_CREAT | os.O_WRONLY, 0o600), "wb") as file,
            tarfile.open(fileobj=file, mode="w:gz") as tar,
        ):
            number = _add_all(folder, tar)
        unfinished.rename(archive)
    except OSError as error:
        raise BackupError(f"{archive} cannot be written: {error.strerror or error}.") from None
    finally:
        unfinished.unlink(missing_ok=True)
    return number


def _add_all(folder: Path, tar: tarfile.TarFile) -> int:
    now = datetime.now(UTC).isoformat(timespec="seconds")
    manifest = {"format": FORMAT, "svsa": __version__, "time": now}
    _add_bytes(tar, MANIFEST, json.dumps(manifest).encode())
    number = 0
    for path in sorted(folder.rglob("*")):
        if any(path.match(pattern) for pattern in _LEFT_OUT) or path.is_symlink():
            continue
        name = str(path.relative_to(folder))
        # A recording that ends during the backup renames its files; the archive already has them.
        with contextlib.suppress(FileNotFoundError):
            if path.suffix == _DATABASE and path.is_file():
                _add_database(tar, path, name)
            elif path.is_file():
                _add_bytes(tar, name, path.read_bytes(), path.stat().st_mode)
            else:
                tar.add(path, name, recursive=False)
                continue
            number += 1
    return number


def _add_bytes(tar: tarfile.TarFile, name: str, content: bytes, mode: int = 0o600) -> None:
    # Read completely first: a file that grows while it is added would damage the archive.
    entry = tarfile.TarInfo(name)
    entry.size, entry.mode, entry.mtime = len(content), mode & 0o777, datetime.now(UTC).timestamp()
    tar.addfile(entry, io.BytesIO(content))


def _add_database(tar: tarfile.TarFile, path: Path, name: str) -> None:
    with tempfile.TemporaryDirectory() as place:
        copy = Path(place) / path.name
        with (
            contextlib.closing(sqlite3.connect(path)) as source,
            contextlib.closing(sqlite3.connect(copy)) as target,
        ):
            source.backup(target)
        _add_bytes(tar, name, copy.read_bytes(), path.stat().st_mode)


def restore(archive: Path, folder: Path) -> str:
    """Extract an archive of `back_up` into an empty or new data folder.

    Args:
        archive: The file.
        folder: The data folder, which must not contain files.

    Returns:
        Version of the lab that wrote the archive.

    Raises:
        BackupError: If the file is not an archive of a lab, has a newer format, or is damaged.
        StateError: If the folder is not empty.
    """
    if folder.exists() and any(folder.iterdir()):
        raise StateError(f"{folder} is not empty: set SVSA_DATA to a new folder, and try again.")
    try:
        with tarfile.open(archive, "r:gz") as tar:
            first = tar.next()
            stream = tar.extractfile(first) if first and first.name == MANIFEST else None
            if stream is None:
                raise BackupError(f"{archive} is not an archive of `svsa backup`.")
            manifest = load_json(stream.read())
            if manifest["format"] > FORMAT:
                raise BackupError(
                    f"{archive} has format {manifest['format']} of svsa {manifest['svsa']}; this"
                    f" version reads format {FORMAT}. Update the lab first."
                )
            folder.mkdir(parents=True, exist_ok=True)
            # The filter rejects names that lead out of the folder.
            tar.extractall(
                folder, (member for member in tar if member.name != MANIFEST), filter="data"
            )
    except (OSError, tarfile.TarError, EOFError, ValueError, KeyError, TypeError) as error:
        raise BackupError(f"{archive} cannot be restored: {error}.") from None
    return str(manifest["svsa"])

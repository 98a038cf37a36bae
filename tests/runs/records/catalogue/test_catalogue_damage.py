"""Damage of the catalogue and of single runs: the others are listed, and nothing is destroyed."""

import json
import os
import random
import shutil
import sqlite3
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import pytest

from svsa.runs.records.catalogue.entry import CatalogueError, UnknownRunError
from svsa.runs.records.catalogue.runs import Catalogue
from svsa.runs.records.header import HEADER_FILE, LARGEST_TEXT_BYTES, RecordError
from tests.exhaustive import exhaust
from tests.runs.records.records import add, list_ids

RUNS = ["run-1", "run-2", "run-3"]
NAME = "catalogue.sqlite"
FEW, MANY = 40, 500
FORMER = (75, 245, 251, 295, 405, 435)
"""Seeds of damages that prevented the start: texts in messages of SQLite that are not UTF-8."""


@pytest.fixture(scope="module")
def intact(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a catalogue with three runs that no process uses."""
    folder = tmp_path_factory.mktemp("intact")
    catalogue = Catalogue(folder)
    for number, run_id in enumerate(RUNS):
        add(catalogue, run_id, name=f"Größe {number}", tags=("class", f"ε{number}"))
    catalogue.close()
    with sqlite3.connect(folder / NAME) as connection:
        connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")
    connection.close()
    return folder


@pytest.fixture
def data(intact: Path, tmp_path: Path) -> Path:
    return shutil.copytree(intact, tmp_path / "data")


def damage(content: bytes, seed: int) -> bytes:
    """Flip one bit, overwrite a stretch, cut or repeat: each seed once."""
    chance = random.Random(seed)  # noqa: S311
    broken = bytearray(content)
    at = chance.randrange(len(broken))
    match seed % 5:
        case 0 | 1:
            # Half of the damages are where the tables are described.
            at = chance.randrange(4096) if seed % 2 else at
            broken[at] ^= 1 << chance.randrange(8)
        case 2:
            length = chance.choice((1, 8, 100, 5000))
            broken[at : at + length] = chance.randbytes(length)
        case 3:
            del broken[at:]
        case _:
            other = chance.randrange(len(broken))
            broken[at : at + 4096] = broken[other : other + 4096]
    return bytes(broken)


def use(catalogue: Catalogue) -> None:
    """Call what the server calls."""
    listed = catalogue.list(search="größe", sort="name")
    assert {run.id for run in listed.runs} <= {*RUNS} | {run.id for run in catalogue.list().runs}
    for sort in ("created", "-bytes", "laws"):
        catalogue.list(sort=sort, tag="class")
    catalogue.list_facets()
    catalogue.measure_bytes("")
    for run_id in RUNS:
        catalogue.update(run_id, notes="changed")
        catalogue.delete(run_id)
        catalogue.restore(run_id)


def check_damages(data: Path, name: str, seeds: Iterable[int]) -> None:
    content = (data / name).read_bytes()
    for seed in seeds:
        for path in data.glob(f"{NAME}*"):
            path.unlink()
        (data / NAME).write_bytes((data / "intact.sqlite").read_bytes())
        (data / name).write_bytes(damage(content, seed))
        catalogue = Catalogue(data)
        catalogue.recover()
        use(catalogue)
        assert {*RUNS} <= {*list_ids(catalogue)}, seed
        catalogue.close()


@pytest.mark.parametrize("seeds", [
    (*range(FEW // 2), *FORMER),
    pytest.param(range(MANY), marks=pytest.mark.exhaustive),
], ids=["few", "many"])  # fmt: skip
def test_damaged_catalogue_is_rebuilt_at_the_start(
    data: Path, seeds: Iterable[int], caplog: pytest.LogCaptureFixture
) -> None:
    shutil.copy(data / NAME, data / "intact.sqlite")
    check_damages(data, NAME, seeds)
    assert caplog.messages
    assert not any("\n" in message for message in caplog.messages)


@pytest.mark.exhaustive
@pytest.mark.parametrize("ending", exhaust(["-wal", "-shm", "-journal"], ["-wal"]))
def test_damaged_log_does_not_prevent_the_start(data: Path, ending: str) -> None:
    shutil.copy(data / NAME, data / "intact.sqlite")
    keep = sqlite3.connect(data / NAME)
    keep.execute("UPDATE runs SET name = 'changed'")
    keep.commit()
    path = data / f"{NAME}{ending}"
    content = path.read_bytes() if path.exists() else bytes(8192)
    keep.close()
    path.write_bytes(content)
    check_damages(data, path.name, range(FEW // 2))


@pytest.mark.exhaustive
@pytest.mark.parametrize("seeds", [range(FEW), range(FEW, MANY // 3)], ids=["few", "many"])
def test_damage_is_repaired_while_the_catalogue_is_used(data: Path, seeds: range) -> None:
    content = (data / NAME).read_bytes()
    catalogue = Catalogue(data)
    for seed in seeds:
        catalogue.list()
        for path in data.glob(f"{NAME}-*"):
            path.unlink()
        (data / NAME).write_bytes(damage(content, seed))
        use(catalogue)
        catalogue.recover()
        assert {*RUNS} <= {*list_ids(catalogue)}, seed


SCRIPTS = {
    "a table is missing": "DROP TABLE facets",
    "a column is missing": "ALTER TABLE runs DROP COLUMN search",
    "an index is missing": "DROP INDEX runs_by_owner",
    "other types": "DROP TABLE entries; CREATE TABLE entries (id INTEGER, entry BLOB)",
    "text in columns of numbers": "UPDATE runs SET bytes = 'many', trash = 'x', duration_s = '∞'",
    "numbers in columns of text": "UPDATE entries SET entry = 7",
    "bytes in columns of text": "UPDATE counts SET value = x'ff' WHERE value = 'class'",
    "invalid text": "UPDATE entries SET entry = CAST(x'7bff' AS TEXT)",
    "another JSON": "UPDATE entries SET entry = '[]'",
    "deep JSON": f"UPDATE entries SET entry = '{'[' * 100_000}'",  # noqa: S608
    "wrong fields": "UPDATE entries SET entry = json_set(entry, '$.ticks', 'x', '$.state', 'odd')",
    "absurd numbers": "UPDATE entries SET entry = json_set(entry, '$.bytes', 1e300)",
    "no entries": "DELETE FROM entries",
    "no rows": "DELETE FROM runs",
    "unknown filters": "INSERT INTO facets VALUES ('size', 'big', 'run-1', 0)",
    "a newer format": "PRAGMA user_version = 99",
    "an older format that it is not": "DROP TABLE entries; PRAGMA user_version = 3",
    "a negative format": "PRAGMA user_version = -1",
}


@pytest.mark.parametrize("script", SCRIPTS.values(), ids=SCRIPTS)
@pytest.mark.parametrize("when", ["at the start", "in use"])
def test_invalid_content_is_replaced(data: Path, script: str, when: str) -> None:
    catalogue = Catalogue(data)
    expected = catalogue.list(sort="name").runs
    connection = sqlite3.connect(data / NAME)
    connection.executescript(script)
    connection.close()
    if when == "at the start":
        catalogue = Catalogue(data)
        catalogue.recover()
    use(catalogue)
    catalogue.recover()
    runs = catalogue.list(sort="name").runs
    assert [run.id for run in runs] == [run.id for run in expected]
    assert [run.name for run in runs] == [run.name for run in expected]
    assert catalogue.list_facets()["tag"]["class"] == len(RUNS)


def make_empty(path: Path) -> None:
    path.write_bytes(b"")


def make_foreign(path: Path) -> None:
    with sqlite3.connect(path) as connection:
        connection.executescript("CREATE TABLE runs (km REAL); INSERT INTO runs VALUES (42.2)")
    connection.close()


def make_circle(path: Path) -> None:
    path.symlink_to(path.name)


def make_dangling(path: Path) -> None:
    path.symlink_to(path.parent / "missing" / "file")


@pytest.mark.parametrize(
    "make", [make_empty, make_foreign, Path.mkdir, os.mkfifo, make_circle, make_dangling]
)
@pytest.mark.parametrize("ending", ["", "-wal", "-shm", "-journal"])
def test_what_is_in_place_of_a_file_is_set_aside(
    data: Path, make: Callable[[Path], None], ending: str
) -> None:
    path = data / f"{NAME}{ending}"
    path.unlink(missing_ok=True)
    make(path)
    catalogue = Catalogue(data)
    catalogue.recover()
    use(catalogue)
    assert list_ids(catalogue, sort="name") == RUNS
    if (make, ending) == (make_foreign, ""):
        with sqlite3.connect(data / f"{NAME}.damaged-1") as connection:
            assert connection.execute("SELECT km FROM runs").fetchall() == [(42.2,)]
        connection.close()


def test_locked_catalogue_is_not_set_aside(data: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("svsa.runs.records.catalogue.database.BUSY_TIMEOUT_S", 0.1)
    catalogue = Catalogue(data)
    holder = sqlite3.connect(data / NAME, isolation_level=None)
    holder.execute("BEGIN EXCLUSIVE")
    with pytest.raises(CatalogueError, match="locked"):
        catalogue.update("run-1", notes="later")
    holder.execute("ROLLBACK")
    holder.close()
    assert catalogue.update("run-1", notes="later").notes == "later"
    assert not list(data.glob("*.damaged-*"))


FIELDS = ("format", "version", "run_id", "created", "plant", "tags", "branch_of", "lanes",
          "configuration", "seed", "period_s", "steps", "channels")  # fmt: skip
VALUES = (None, "x", -1, 1e308, [], [[]], {"a": {}}, True, "9" * 4000, "\ud800")
HEADERS: dict[str, bytes] = {
    "deep": b'{"a":' * 100_000,
    "deep configuration": b'{"format":1,"configuration":' + b'{"a":' * 900 + b"1" + b"}" * 901,
    "huge number": b'{"format":1,"seed":' + b"9" * 10_000 + b"}",
    "invalid UTF-8": b'{"format":1,"name":"\xff\xfe"}',
    "infinite": b'{"format":1,"period_s":Infinity}',
    "list": b"[1]",
    "empty": b"",
    "cut": b'{"format":1,',
    "NUL": bytes(1000),
}


@pytest.mark.parametrize("content", HEADERS.values(), ids=HEADERS)
def test_damaged_header_stops_no_other_run(data: Path, content: bytes) -> None:
    check_others(data, lambda path: path.write_bytes(content))


@pytest.mark.parametrize("field", exhaust(FIELDS, ["channels", "created", "tags"]))
def test_invalid_field_stops_no_other_run(data: Path, field: str) -> None:
    header = json.loads((data / "runs" / "run-2" / HEADER_FILE).read_bytes())
    texts = [json.dumps(header | {field: value}) for value in VALUES]
    texts.append(json.dumps({name: header[name] for name in header if name != field}))
    for text in texts:
        check_others(data, lambda path, text=text: path.write_text(text), is_damaged=False)


@pytest.mark.parametrize(
    "make",
    [Path.mkdir, os.mkfifo, make_circle, make_dangling, lambda path: path.symlink_to("/dev/zero")],
    ids=["folder", "pipe", "circle", "dangling", "device"],
)
@pytest.mark.parametrize("name", [HEADER_FILE, "samples.parquet", "commands.jsonl",
                                  "samples.arrows", "fault.json", "events.json"])  # fmt: skip
def test_what_is_in_place_of_a_runs_file_stops_no_other_run(
    data: Path, make: Callable[[Path], Any], name: str
) -> None:
    (data / "runs" / "run-2" / name).unlink(missing_ok=True)
    check_others(data, make, name, is_damaged=name in (HEADER_FILE, "samples.parquet"))


@pytest.mark.parametrize("name", [HEADER_FILE, "fault.json", "events.json"])
def test_huge_file_is_not_read(data: Path, name: str) -> None:
    def grow(path: Path) -> None:
        path.touch()
        os.truncate(path, 1 << 30)

    check_others(data, grow, name)
    (message,) = [run.message for run in Catalogue(data).list().runs if run.id == "run-2"]
    assert "1073741824 bytes" in message


def check_others(
    data: Path, make: Callable[[Path], Any], name: str = HEADER_FILE, is_damaged: bool = True
) -> None:
    """Damage a file of the second run, and list all runs with an old and with a new catalogue."""
    make(data / "runs" / "run-2" / name)
    for again in (False, True):
        for path in data.glob(f"{NAME}*") if again else ():
            path.unlink()
        catalogue = Catalogue(data)
        catalogue.recover()
        states = {run.id: run.state for run in catalogue.list().runs}
        assert states.keys() == {*RUNS}
        assert states["run-1"] == states["run-3"] == "complete"
        assert not is_damaged or states["run-2"] == "damaged"
        if states["run-2"] == "damaged":
            with pytest.raises((RecordError, UnknownRunError)):
                catalogue.open("run-2").samples  # noqa: B018
        catalogue.close()


def test_limit_of_a_header_is_far_above_the_largest_one(data: Path) -> None:
    largest = max(path.stat().st_size for path in data.rglob(HEADER_FILE))
    assert 100 * largest < LARGEST_TEXT_BYTES

"""Read the audit log, newest first, in a worker process."""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

from starlette.routing import compile_path

from svsa.inputs.stored_file import load_json
from svsa_server.access.audit import FILE
from svsa_server.leases.lease import CHANGING

OTHER = "other"
_LONGEST_LINE = 20_000


class Operation(NamedTuple):
    """An operation of the API by method and path pattern: its kind and its title."""

    method: str
    pattern: str
    kind: str
    name: str


class Question(NamedTuple):
    """Which entries to read; empty or None selects any.

    Attributes:
        person: Id of a user.
        kind: Kind of an `Operation`.
        refused: Whether it was rejected.
        until: Time of the newest entry to return, so that pages stay the same while lines are
            added.
        page: Number of the page.
        page_size: Entries per page.
    """

    person: str
    kind: str
    refused: bool | None
    until: str
    page: int
    page_size: int


def list_operations(schema: dict[str, Any]) -> list[Operation]:
    """List every state-changing operation of an OpenAPI schema, by its first tag."""
    return [
        Operation(
            method.upper(),
            compile_path(path)[0].pattern,
            next(iter(operation.get("tags", ())), OTHER),
            operation["operationId"].replace("_", " ").capitalize(),
        )
        for path, item in schema["paths"].items()
        for method, operation in item.items()
        if method.upper() in CHANGING
    ]


def read_audit(folder: Path, operations: list[Operation], asked: Question) -> dict[str, Any]:
    """Read a page of the log in this folder, with the users and kinds that occur in it."""
    known: dict[tuple[str, str], Operation | None] = {}
    people: dict[str, str] = {}
    kinds: set[str] = set()
    lines, total, newest = [], 0, asked.until
    first = (asked.page - 1) * asked.page_size
    for line in read_backwards(folder):
        if asked.until and line["time"] > asked.until:
            continue
        newest = newest or line["time"]
        entry = report(line, operations, known)
        kinds.add(entry["kind"])
        if entry["person"] is not None:
            people.setdefault(entry["person"], entry["name"] or entry["person"])
        if not _is_asked_for(entry, asked):
            continue
        if first <= total < first + asked.page_size:
            lines.append(entry)
        total += 1
    return {
        "lines": lines,
        "total": total,
        "until": newest,
        "people": [{"id": key, "name": name} for key, name in people.items()],
        "kinds": sorted(kinds),
    }


def _is_asked_for(entry: dict[str, Any], asked: Question) -> bool:
    return (
        (not asked.person or entry["person"] == asked.person)
        and (not asked.kind or entry["kind"] == asked.kind)
        and (asked.refused is None or entry["refused"] is asked.refused)
    )


def report(
    line: dict[str, Any],
    operations: list[Operation],
    known: dict[tuple[str, str], Operation | None],
) -> dict[str, Any]:
    """Format an entry for display; `known` caches resolved requests."""
    status, problem = line.get("status"), line.get("problem")
    if "method" in line:
        call = line["method"], line["path"]
        if call not in known:
            known[call] = _find_operation(*call, operations)
        operation = known[call]
        kind, did = (operation.kind, operation.name) if operation else (OTHER, " ".join(call))
    elif "event" in line:
        kind, did = line["event"], f"{line['event']} went on".capitalize()
        problem = str(line["why"]).replace("_", " ")
    else:
        kind, did = "lti", str(line.get("action", "")).removeprefix("lti ").capitalize()
    return {
        "time": line["time"],
        "person": line.get("person"),
        "name": line.get("name"),
        "role": line.get("role"),
        "kind": kind,
        "did": did,
        "path": line.get("path"),
        "status": status,
        "refused": status >= 400 if status is not None else "event" not in line and bool(problem),
        "why": problem,
        "session": line.get("session"),
        "run_number": line.get("run"),
        "tick": line.get("tick"),
    }


def _find_operation(method: str, path: str, operations: list[Operation]) -> Operation | None:
    matching = (
        operation
        for operation in operations
        if operation.method == method and re.match(operation.pattern, path)
    )
    return next(matching, None)


def read_backwards(folder: Path) -> Iterator[dict[str, Any]]:
    """Yield the lines of every log file, newest first; invalid lines are skipped."""
    files = [folder / FILE, *sorted(folder.glob(f"{FILE}.*"), key=_count_aside)]
    for path in files:
        if not path.is_file():
            continue
        lines = path.read_bytes().splitlines()
        for written in reversed(lines):
            try:
                line = load_json(written[:_LONGEST_LINE])
            except ValueError:
                continue
            if isinstance(line, dict) and isinstance(line.get("time"), str):
                yield line


def _count_aside(path: Path) -> int:
    """Return the number of rotations of a file: 1 is the newest rotated file."""
    number = path.suffix.removeprefix(".")
    return int(number) if number.isdecimal() else 0

"""Reference pages of what users call: commands, REST operations, the stream's messages."""

import json
from collections.abc import Mapping
from importlib.metadata import entry_points
from pathlib import Path
from typing import Any

import typer.main
from markdown_table import NONE, format_table
from typer.cli import get_docs_for_click

from svsa.cli import app
from svsa_server.schemas.lab.stream import describe_stream
from svsa_server.sessions.cursor import BATCH_PERIOD_S

OPENAPI = Path(__file__).with_name("openapi.json")
METHODS = ("get", "put", "post", "patch", "delete")


def write_commands() -> str:
    """The command line."""
    command = typer.main.get_command(app)
    for entry in entry_points(group="svsa.commands"):
        if entry.name not in command.commands:  # pyright: ignore[reportAttributeAccessIssue]
            app.command(entry.name)(entry.load())
    command = typer.main.get_command(app)
    context = command.context_class(command, info_name="svsa")
    text = get_docs_for_click(obj=command, ctx=context, name="svsa", title="Commands")
    return text.replace("&#x27;", "'")


def write_rest() -> str:
    """Every operation of the REST interface."""
    schema = json.loads(OPENAPI.read_text(encoding="utf-8"))
    grouped: dict[str, list[str]] = {tag["name"]: [] for tag in schema["tags"]}
    for path, item in schema["paths"].items():
        for method in METHODS:
            if method in item:
                tag = item[method].get("tags", ["other"])[0]
                grouped.setdefault(tag, []).append(_format_operation(method, path, item[method]))
    groups = "\n".join(
        f"## {tag.capitalize()}\n\n" + "\n".join(rows) for tag, rows in grouped.items() if rows
    )
    return f"""# REST

Addresses are relative to the lab. Bodies and answers are JSON in SI units. Errors are problems of
RFC 9457. The running lab has the same list with every field and a form to try it under `/docs`, and
the schema under `/openapi.json`.

{groups}
"""


def _format_operation(method: str, path: str, operation: Mapping[str, Any]) -> str:
    permission = operation.get("x-permission", NONE)
    answers = ", ".join(operation["responses"])
    text = operation.get("description", "").strip() or operation.get("summary", "")
    named = [
        (f"`{one['name']}`", one["in"], one.get("description", NONE))
        for one in operation.get("parameters", [])
        if one["in"] == "query"
    ]
    table = f"\n\n{format_table(('parameter', 'in', 'meaning'), named)}" if named else ""
    return (
        f"### `{method.upper()} {path}`\n\n{text}\n\n"
        f"Permission: {permission}. Status codes: {answers}.{table}\n"
    )


def write_stream() -> str:
    """The messages of the stream."""
    return f"# Stream of samples\n\n{describe_stream(BATCH_PERIOD_S)}\n"

"""The commands that the server adds to `svsa`."""

import gc
import json
from pathlib import Path
from typing import Annotated, Any

import typer

from svsa.inputs.extras import require_extra


def serve(
    host: Annotated[
        str,
        typer.Option(
            help="Address to listen on. 'auto': all addresses if SVSA_SECRET or --class is set,"
            " otherwise 127.0.0.1."
        ),
    ] = "127.0.0.1",
    port: Annotated[int, typer.Option(min=0, max=65535, help="Port; 0 selects a free one.")] = 8000,
    bench: Annotated[
        Path | None, typer.Option(help="Bench file of the bench to drive; default: a simulation.")
    ] = None,
    parameters: Annotated[
        Path | None,
        typer.Option(help="Parameter file, such as from `svsa identify`; default: the paper's."),
    ] = None,
    classroom: Annotated[
        bool,
        typer.Option(
            "--class",
            help="Open a class: students join with a name and a class code.",
        ),
    ] = False,
    root_path: Annotated[
        str,
        typer.Option(
            help="Path under which a proxy serves the lab, such as /svsa. The proxy removes it."
        ),
    ] = "",
    course: Annotated[
        Path | None,
        typer.Option(help="Folder with additional exercises."),
    ] = None,
) -> None:
    """Start the lab: the page, the REST interface, the streams and the 3D view.

    A lab that other machines can reach needs --class, or a shared secret in SVSA_SECRET.
    """
    require_extra("server")
    gc.disable()  # until the server listens: the objects of the imports stay
    try:
        from svsa_server.commands.serve import run_server

        run_server(host, port, bench, parameters, classroom, course, root_path)
    finally:
        gc.enable()


def excite(
    url: Annotated[str, typer.Option(help="Address of the lab.")] = "http://127.0.0.1:8000",
    session: Annotated[str, typer.Option(help="Session to excite.")] = "lab",
    name: Annotated[str, typer.Option(help="Name of the run.")] = "Identification",
) -> None:
    """Play the excitation for `svsa identify` on a running lab, 32 s, and record it.

    If the lab has a secret, set SVSA_SECRET. A bench must be armed first.
    """
    require_extra("server")
    from svsa_server.commands.excite import play_excitation

    play_excitation(url, session, name)


def openapi(
    permissions: Annotated[
        bool,
        typer.Option(
            "--permissions", help="Print the table of permissions as text instead of the schema."
        ),
    ] = False,
    settings: Annotated[
        bool,
        typer.Option(
            "--settings", help="Print a commented example of the settings instead of the schema."
        ),
    ] = False,
) -> None:
    """Print the OpenAPI schema of the server."""
    require_extra("server")
    if settings:
        from svsa_server.config import write_example

        print(write_example(), end="")
        return
    from svsa_server.app import build_app

    app = build_app()
    if permissions:
        print(app.state.permissions.write(), end="")
    else:
        print(_write_lines(app.openapi(), depth=3))


def _write_lines(schema: dict[str, Any], depth: int) -> str:
    """JSON with a line for each operation and each component, so that a diff shows what changed."""
    if depth == 0 or not isinstance(schema, dict):
        return json.dumps(schema)
    lines = (f"{json.dumps(key)}: {_write_lines(part, depth - 1)}" for key, part in schema.items())
    return "{\n" + ",\n".join(lines) + "\n}"

"""Listen, print the address, and serve until a signal ends the server."""

import asyncio
import gc
import logging
import os
import socket
import sys
import threading
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import IO, cast

import uvicorn
from pythonjsonlogger.json import JsonFormatter
from rich.console import Console
from uvicorn.config import LOGGING_CONFIG

from svsa.actuators.parameters import get_mechanism_name
from svsa.control.installed import BASELINE, PAPERS_LAW
from svsa.errors import ParameterError, StateError, SvsaError, Violation
from svsa.hardware.description.file import read_bench
from svsa.hardware.realtime.configuration import read_bench_design
from svsa.hardware.safety.heartbeat import check_shared_memory
from svsa.inputs.data_folder import DATA_VARIABLE, find_data_folder
from svsa.inputs.file_lock import try_lock
from svsa.runs.definition.design_file import read_design
from svsa.teaching.course.file import read_course
from svsa_server.access.admission import Admission, raise_descriptor_limit
from svsa_server.access.class_keys import FILE, ClassKeys, ShownOnce
from svsa_server.access.connections import BoundHttp, BoundWebSocket
from svsa_server.access.origin import EVERYWHERE
from svsa_server.commands.compiling import compile_laws, prepare_apart
from svsa_server.commands.console import HINT, watch_keyboard
from svsa_server.config import Settings
from svsa_server.repeated_errors import limit_repeated_errors

SEND_BUFFER_BYTES = 64 * 1024
KEPT_S = 15
"""Time for which an idle connection is kept, s: httpx reuses connections within 5 s, and a request
on a connection that is closed at that moment is lost.
"""


BACKLOG = 2048
"""Connections that the system keeps until they are accepted."""
ACCEPTED_AT_ONCE = 8
"""Connections that are accepted before those over the limit are closed."""
LOCK_FILE = "server.lock"
LONGEST_EXIT_S = 10.0
"""Maximum time from closing the sessions to the exit, s, while a computing thread is waited for."""


class ListenError(SvsaError):
    """The address cannot be listened on."""


def bind(host: str, port: int) -> socket.socket:
    """Bind a socket with a small send buffer, so that slow clients are detected early.

    Raises:
        ListenError: If that fails, with the reason and what to do.
    """
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    listener = socket.socket(family, socket.SOCK_STREAM)
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, SEND_BUFFER_BYTES)
    try:
        listener.bind((host.strip("[]"), port))
    except OSError as error:
        listener.close()
        raise ListenError(
            f"Cannot listen on {host}:{port}: {error.strerror or error}. Try another --port."
        ) from None
    return listener


class AnnouncedServer(uvicorn.Server):
    """A server that prints its address once it accepts requests.

    Objects that exist by then are excluded from garbage collection, which would take 0.2 s each
    time and block the server; the collector is enabled at that time.
    """

    announcement = ""

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        """Start as uvicorn does, then print the announcement."""
        await super().startup(sockets)
        # Only now: asyncio also takes this number for the connections that it accepts at once.
        for listener in sockets or ():
            listener.listen(BACKLOG)
        gc.freeze()
        gc.enable()
        if self.started:
            Console(soft_wrap=True).print(self.announcement, highlight=False)


def run_server(
    host: str,
    port: int,
    bench: Path | None,
    parameters: Path | None,
    classroom: bool = False,
    course: Path | None = None,
    root_path: str = "",
) -> None:
    """Serve the lab until a signal ends it, with a bench if its file is given.

    A bench is opened while the lab is already served, see `open_bench`.

    Raises:
        SecurityError: If the lab would be reachable without authentication.
        ListenError: If the server cannot listen.
        ParameterError: If a bench file or exercise is invalid.
        StateError: Without shared memory.
    """
    config = Settings()
    bench = bench or config.bench
    config = config.model_copy(
        update={
            "parameters": parameters or config.parameters,
            "classroom": classroom or config.classroom,
            "course": course or config.course,
            "root_path": root_path or config.root_path,
        }
    )
    if bench is not None and config.parameters is not None:
        bound = "omitted with a bench: set [design] file in the bench file"
        raise ParameterError(Violation("--parameters", str(config.parameters), "", bound))
    if config.log == "json":
        write_json_logs()
    config.check_root_path()
    check_shared_memory()
    design = read_design(config.parameters) if config.parameters else None
    read_course(config.course)
    chosen = config.choose_host(host)
    config.check_exposure(chosen)
    if config.classroom and sys.platform != "win32":
        # Only the account of the server may read names, addresses and runs of a class.
        os.umask(0o077)
    # Before laws are compiled, so that a port or folder in use is reported at once.
    listener = bind(chosen, port)
    claim = claim_data_folder(find_data_folder())
    # The loop of a bench cannot wait for the compiler: all laws are compiled before it starts.
    if bench is None:
        prepare_apart(print_line, (PAPERS_LAW, BASELINE))
    else:
        actuator = get_mechanism_name(read_bench_design(read_bench(bench)).actuator)
        prepare_apart(print_line, actuator=actuator)
        # Otherwise imported at the first record, which would hold back the server for 0.1 s.
        import_module("pyarrow.parquet")
    keys, reported = ClassKeys.open(find_data_folder()) if config.classroom else (None, None)
    from svsa_server.app import build_app  # imported here: rejections come first
    from svsa_server.responsive import ResponsiveApp
    from svsa_server.sessions.laboratory import build_shared_session

    shared = build_shared_session(bench, design)
    # Sessions run in a separate thread: if one blocks, health checks, the quick stop and the
    # shutdown still work in this thread.
    lab = ResponsiveApp(build_app(config, shared, keys, chosen, print_line), shared)
    admission = Admission(lab, config.max_connections, raise_descriptor_limit())
    server = AnnouncedServer(
        uvicorn.Config(
            admission,
            log_level="warning",
            # In JSON format all loggers write through one handler.
            log_config=None if config.log == "json" else LOGGING_CONFIG,
            http=cast(type[asyncio.Protocol], partial(BoundHttp, admission=admission)),
            ws=cast(type[asyncio.Protocol], partial(BoundWebSocket, admission=admission)),
            backlog=ACCEPTED_AT_ONCE,
            ws_max_size=65536,
            # A client that stops reading is noticed at the next ping, so both count.
            ws_ping_interval=config.silence_s / 2.0,
            ws_ping_timeout=config.silence_s / 2.0,
            ws_per_message_deflate=False,
            timeout_keep_alive=KEPT_S,
            timeout_graceful_shutdown=2,
            root_path=config.root_path,
        )
    )
    limit_repeated_errors()
    server.announcement = describe_address(host, chosen, listener.getsockname()[1])
    if keys is not None:
        server.announcement += f"\n{describe_class(reported)}"
    try:
        with compile_laws(), watch_keyboard(shared.stop_from_keyboard) as watched:
            if watched and bench:
                server.announcement += f"\n{HINT}"
            server.run(sockets=[listener])
    finally:
        if claim is not None:
            claim.close()
        _bound_exit(lab.is_stuck)


def claim_data_folder(folder: Path) -> IO[str] | None:
    """Lock a data folder against other servers as long as the returned file is open.

    Two servers would finish, rename and delete each other's recordings.

    Args:
        folder: The data folder; it is created if it does not exist.

    Returns:
        The locked file; None if the folder cannot be written, because then no run is recorded.

    Raises:
        StateError: If another server uses this folder.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        file = (folder / LOCK_FILE).open("a+", encoding="utf-8")
    except OSError:
        return None
    if not try_lock(file.fileno()):
        file.seek(0)
        process = file.read().strip() or "unknown"
        file.close()
        raise StateError(
            f"Another lab (process {process}) uses the data folder {folder}: stop it, or set"
            f" {DATA_VARIABLE} to another folder."
        )
    file.truncate(0)
    file.write(f"{os.getpid()}\n")
    file.flush()
    return file


def write_json_logs() -> None:
    """Write all logs to standard error as JSON, one object per line."""
    fields = {"asctime": "time", "levelname": "level", "name": "logger"}
    handler = logging.StreamHandler()
    handler.setFormatter(
        JsonFormatter("%(asctime)s %(levelname)s %(name)s %(message)s", rename_fields=fields)
    )
    logging.basicConfig(handlers=[handler], level=logging.INFO, force=True)


def print_line(line: str) -> None:
    """Print a line on the lab's console."""
    Console(soft_wrap=True).print(line, highlight=False, markup=False)


def _bound_exit(is_stuck: bool) -> None:
    """End the process even if one of its threads does not end."""
    if is_stuck:
        os._exit(1)
    exiting = threading.Timer(LONGEST_EXIT_S, os._exit, (1,))
    exiting.daemon = True
    exiting.start()


def describe_class(reported: ShownOnce | None) -> str:
    """The credentials of the class, shown once at its first start."""
    if reported is None:
        return (
            "A class: its code and instructor token are those of its first start. The instructor's"
            f" page makes a new code; without {FILE} in SVSA_DATA the next start makes new ones."
        )
    return (
        f"A class. Students join with their name and the code [bold]{reported.code}[/].\n"
        f"The instructor's token: [bold]{reported.instructor_token}[/]\n"
        "Write down both now: the lab stores only their hashes and does not show them again."
    )


def describe_address(asked: str, host: str, port: int) -> str:
    """Describe the lab's address, and from where it can be reached."""
    everywhere = host in EVERYWHERE
    name = "localhost" if everywhere else host
    reach = " and on every address of this machine" if everywhere else ""
    text = f"SVSA Lab is at [bold]http://{name}:{port}/[/]{reach}  (stop with Ctrl-C)"
    if asked == "auto" and not everywhere:
        text += (
            "\nOnly this machine or container reaches it: others need --class, or SVSA_SECRET set."
        )
    return text

"""The audit log of a class: user, action, session and tick, as lines of JSON.

It does not contain the content of requests, and therefore no secrets; the commands of a run are in
its record.
"""

import json
import logging
import os
import sys
from datetime import UTC, datetime
from logging.handlers import QueueHandler, QueueListener, RotatingFileHandler
from pathlib import Path
from queue import SimpleQueue
from threading import Lock
from typing import Any

from starlette.types import ASGIApp, Message, Receive, Scope, Send

from svsa.inputs.file_lock import close_to_others
from svsa.inputs.set_aside import set_aside
from svsa_server.access.guard import PERSON, find_path
from svsa_server.access.permissions import PermissionTable
from svsa_server.leases.lease import CHANGING

FILE = "audit.jsonl"
_log = logging.getLogger("svsa")
_MAX_BYTES, _FILES = 10 * 1024 * 1024, 5
_PLAIN = "%(message)s"
NOWHERE = {"run": None, "tick": None, "in_control": None}
"""Fields of a request that is not about a session; otherwise see `HostedSession.read_instant`."""


class _LogFile(RotatingFileHandler):
    def handleError(self, record: logging.LogRecord) -> None:  # noqa: N802  name of `logging`
        """Report in one line why an entry is missing."""
        _log.error("An entry of the audit log is not stored: %s", sys.exc_info()[1])


class AuditLog:
    """Written in a thread, so that the event loop waits for no disk; a full file is rotated."""

    def __init__(self, folder: Path) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        path = folder / FILE
        if os.path.lexists(path) and not path.is_file():
            _log.warning("%s is not a file: it is kept as %s.", path, set_aside(path).name)
        close_to_others(path)
        file = _LogFile(path, maxBytes=_MAX_BYTES, backupCount=_FILES, encoding="utf-8", delay=True)
        file.setFormatter(logging.Formatter(_PLAIN))
        queue: SimpleQueue[Any] = SimpleQueue()
        self._logger = logging.Logger("svsa.audit")
        self._logger.addHandler(QueueHandler(queue))
        self._listener = QueueListener(queue, file)
        self._file = file
        self._turn = Lock()
        self._listener.start()

    def write(self, **line: Any) -> None:
        """Add an entry. Later versions may add fields, and never rename or remove one."""
        now = datetime.now(UTC).isoformat(timespec="milliseconds")
        self._logger.info("%s", json.dumps({"time": now} | line, ensure_ascii=False))

    def catch_up(self) -> None:
        """Wait until all earlier entries are in the file; call it in a thread, not the event
        loop.
        """
        with self._turn:
            # `stop` returns once the queue is empty.
            self._listener.stop()
            self._listener.start()

    def close(self) -> None:
        """Write the remaining lines."""
        with self._turn:
            self._listener.stop()
        self._file.close()


class Auditor:
    """ASGI middleware that logs each state-changing request, done or rejected, before the
    answer.
    """

    def __init__(self, app: ASGIApp, log: AuditLog, permissions: PermissionTable) -> None:
        self._app, self._log, self._permissions = app, log, permissions

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass the request on, and log its result."""
        if scope["type"] != "http" or scope["method"] not in CHANGING:
            await self._app(scope, receive, send)
            return
        is_noted = False

        async def send_noted(message: Message) -> None:
            nonlocal is_noted
            # Before the answer is sent: the log is complete for a client that opens it next.
            if not is_noted:
                self._note(scope, message["status"])
                is_noted = True
            await send(message)

        try:
            await self._app(scope, receive, send_noted)
        finally:
            if not is_noted:
                self._note(scope, 500)

    def _note(self, scope: Scope, status: int) -> None:
        method, path, person = scope["method"], find_path(scope), scope.get(PERSON)
        session = self._permissions.find(method, path).named.get("session")
        hosted = scope["app"].state.laboratory.sessions.get(session)
        self._log.write(
            person=person.id if person else None,
            name=person.name if person else None,
            role=person.role.word if person else None,
            address=scope["client"][0] if scope.get("client") else None,
            method=method,
            path=path,
            status=status,
            session=session,
            **(hosted.read_instant() if hosted else NOWHERE),
        )

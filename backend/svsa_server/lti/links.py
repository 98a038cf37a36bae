"""Links between grades and the platform's line items: targets, sent values, retries."""

import logging
import os
import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from typing import NamedTuple

from svsa.inputs.set_aside import SQLITE_FILES, set_aside

FILE = "lti.sqlite"
_log = logging.getLogger(__name__)
_TABLE = (
    "CREATE TABLE IF NOT EXISTS link (person TEXT, exercise TEXT, issuer TEXT, client_id TEXT,"
    " user TEXT, line_item TEXT, sent TEXT NOT NULL DEFAULT '', tries INTEGER NOT NULL DEFAULT 0,"
    " due REAL NOT NULL DEFAULT 0, PRIMARY KEY (person, exercise))"
)


class Link(NamedTuple):
    """A user's points in an exercise, and the line item of a platform that receives them.

    Attributes:
        sent: The submission whose points were delivered, or given up.
        tries: Number of failed attempts for the current points.
        due: Time of the next attempt, s since 1970.
    """

    person: str
    exercise: str
    issuer: str
    client_id: str
    user: str
    line_item: str
    sent: str = ""
    tries: int = 0
    due: float = 0.0


class Links:
    """The links, in a file that only this account can read.

    A damaged file is renamed: each link is learned again at the user's next launch.

    Raises:
        OSError, sqlite3.OperationalError: If the file cannot be used.
    """

    def __init__(self, folder: Path) -> None:
        self._path = folder / FILE
        folder.mkdir(parents=True, exist_ok=True)
        try:
            self._prepare()
        except sqlite3.OperationalError as error:
            # Python reports a text that is not UTF-8 as such an error, without a code.
            if getattr(error, "sqlite_errorcode", None) is not None:
                raise  # locked, full disk, no permission
            self._set_aside(error)
        except (sqlite3.DatabaseError, ValueError, TypeError) as error:
            self._set_aside(error)

    def _prepare(self) -> None:
        with self._open() as file:
            file.execute(_TABLE)
            (state,) = file.execute("PRAGMA integrity_check(1)").fetchone()
        if state != "ok":
            raise ValueError(state)
        for link in self.list():
            if not all(isinstance(text, str) for text in link[:7]):
                raise ValueError("a field is not a text")
            if not isinstance(link.tries, int) or not isinstance(link.due, float):
                raise ValueError("a field is not a number")

    def _set_aside(self, error: Exception) -> None:
        aside = set_aside(self._path, SQLITE_FILES)
        _log.warning(
            "The links to platforms in %s are damaged (%s). They are kept as %s; each is learned"
            " again at the next launch.",
            self._path,
            error,
            aside.name,
        )
        self._prepare()

    def list(self) -> list[Link]:
        """List all links."""
        with self._open() as file:
            return [Link(*row) for row in file.execute("SELECT * FROM link ORDER BY rowid")]

    def learn(self, link: Link) -> None:
        """Store the line item of a launch; what was sent to the same line item stays sent."""
        for known in self.list():
            if known[:6] == link[:6]:
                return
        self.keep(link)

    def keep(self, link: Link) -> None:
        """Save a link, replacing the previous one of the person and exercise."""
        with self._open() as file:
            file.execute("REPLACE INTO link VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)", link)

    @contextmanager
    def _open(self) -> Iterator[sqlite3.Connection]:
        os.close(os.open(self._path, os.O_RDWR | os.O_CREAT, 0o600))
        with closing(sqlite3.connect(self._path)) as file, file:
            yield file

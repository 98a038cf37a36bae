"""Links between grades and the platform's line items: targets, sent values, retries."""

import os
import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from typing import NamedTuple

FILE = "lti.sqlite"
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

    Raises:
        OSError, sqlite3.Error: If the file cannot be used.
    """

    def __init__(self, folder: Path) -> None:
        self._path = folder / FILE
        folder.mkdir(parents=True, exist_ok=True)
        with self._open() as file:
            file.execute(_TABLE)

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

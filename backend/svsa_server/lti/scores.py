"""Grades to the platform: a client of LTI Assignment and Grade Services 2.0, 3.4.

Every ten seconds new grades of users from a platform are sent, once each; failed deliveries are
repeated. Each delivery is logged in the audit log.
"""

import asyncio
import logging
import secrets
import time
from collections.abc import Callable
from datetime import UTC, datetime
from urllib.parse import urlsplit

import httpx
from joserfc import jwt

from svsa.errors import ParameterError
from svsa.teaching.course.progress import ProgressStore
from svsa.teaching.grading.class_grades import open_book
from svsa.teaching.grading.grade import Grade
from svsa.teaching.submission import read_submission
from svsa_server.access.audit import AuditLog
from svsa_server.lti.launch import SCORE_SCOPE
from svsa_server.lti.links import Link
from svsa_server.lti.platforms import Platform
from svsa_server.lti.tool import LtiTool

POLL_S = 10.0
FIRST_WAIT_S, LONGEST_WAIT_S = 30.0, 3600.0
MAX_TRIES = 40
"""Attempts for a day and a half; after that the instructor has to check, and a new launch restarts
them.
"""
_ASSERTION_S = 60
_ASSERTION = "urn:ietf:params:oauth:client-assertion-type:jwt-bearer"
_SCORE_TYPE = "application/vnd.ims.lis.v1.score+json"


class ScoreSender:
    """Sends the grades of the class of `store` to the platforms. clock: s since 1970."""

    def __init__(
        self,
        tool: LtiTool,
        store: ProgressStore,
        audit: AuditLog,
        clock: Callable[[], float] = time.time,
    ) -> None:
        self._tool, self._store, self._audit, self._clock = tool, store, audit, clock
        self._tokens: dict[Platform, tuple[float, str]] = {}

    async def run(self) -> None:
        """Send grades until cancelled."""
        while True:
            await asyncio.sleep(POLL_S)
            try:
                await self.send_due()
            except Exception:
                logging.getLogger(__name__).exception("Grades could not be sent.")

    async def send_due(self) -> None:
        """Send the grades that have not arrived, if their retry is due."""
        for link, grade in await asyncio.to_thread(self._list_due):
            problem = await self._try(link, grade)
            await asyncio.to_thread(self._note, link, grade, problem)

    def _list_due(self) -> list[tuple[Link, Grade]]:
        links, due = self._tool.links.list(), list[tuple[Link, Grade]]()
        if not links:
            return []
        book = open_book(self._store)
        for link in links:
            if link.due > self._clock():
                continue
            path = self._store.find_submission(link.exercise, link.person)
            try:
                digest = read_submission(path).digest if path.exists() else ""
                grade = book.find(digest) if digest not in ("", link.sent) else None
            except ParameterError as error:
                self._audit_score(link, None, str(error))
                continue
            if grade is not None:
                due.append((link, grade))
        return due

    async def _try(self, link: Link, grade: Grade) -> str:
        """Send a score; return why it did not arrive, or an empty text."""
        platform = self._tool.settings.find(link.issuer, link.client_id)
        if platform is None:
            return "The platform is no longer configured."
        try:
            token = await self._get_token(platform)
            answer = await self._tool.client.post(
                build_scores_address(link.line_item),
                json=build_score(link.user, grade, self._clock()),
                headers={"Authorization": f"Bearer {token}", "Content-Type": _SCORE_TYPE},
            )
            if answer.status_code == 401:
                self._tokens.pop(platform, None)
            answer.raise_for_status()
        except (httpx.HTTPError, ValueError, KeyError, TypeError) as error:
            return f"{type(error).__name__}: {error}"[:300]
        return ""

    async def _get_token(self, platform: Platform) -> str:
        """Get an access token with an assertion signed by the lab's key (RFC 7523)."""
        now = self._clock()
        until, token = self._tokens.get(platform, (0.0, ""))
        if until > now:
            return token
        claims = {
            "iss": platform.client_id, "sub": platform.client_id, "aud": platform.token_url,
            "iat": int(now), "exp": int(now) + _ASSERTION_S, "jti": secrets.token_urlsafe(16),
        }  # fmt: skip
        key = self._tool.key
        answer = await self._tool.client.post(
            platform.token_url,
            data={
                "grant_type": "client_credentials",
                "client_assertion_type": _ASSERTION,
                "client_assertion": jwt.encode({"alg": "RS256", "kid": key.kid}, claims, key),
                "scope": SCORE_SCOPE,
            },
        )
        granted = answer.raise_for_status().json()
        token = str(granted["access_token"])
        self._tokens[platform] = now + float(granted.get("expires_in", 0)) - _ASSERTION_S, token
        return token

    def _note(self, link: Link, grade: Grade, problem: str) -> None:
        if not problem:
            link = link._replace(sent=grade.submission, tries=0, due=0.0)
        elif link.tries + 1 >= MAX_TRIES:
            link = link._replace(sent=grade.submission, tries=0, due=0.0)
            problem = f"Given up after {MAX_TRIES} times. {problem}"
        else:
            wait_s = min(FIRST_WAIT_S * 2**link.tries, LONGEST_WAIT_S)
            link = link._replace(tries=link.tries + 1, due=self._clock() + wait_s)
        self._tool.links.keep(link)
        self._audit_score(link, grade, problem)

    def _audit_score(self, link: Link, grade: Grade | None, problem: str) -> None:
        self._audit.write(
            action="lti score",
            person=link.person,
            exercise=link.exercise,
            line_item=link.line_item,
            points=grade and grade.points,
            max_points=grade and grade.max_points,
            problem=problem or None,
        )


def build_scores_address(line_item: str) -> str:
    """Build the address of a line item's scores: `/scores` after its path, before its query."""
    parts = urlsplit(line_item)
    return parts._replace(path=f"{parts.path.rstrip('/')}/scores").geturl()


def build_score(user: str, grade: Grade, now: float) -> dict[str, object]:
    """Build a score in the format of the service, complete and final."""
    return {
        "userId": user,
        "scoreGiven": grade.points,
        "scoreMaximum": grade.max_points,
        "activityProgress": "Completed",
        "gradingProgress": "FullyGraded",
        "timestamp": datetime.fromtimestamp(now, UTC).isoformat(timespec="milliseconds"),
    }

"""How people come in: everybody on this machine, whoever knows a shared secret, or a class."""

import asyncio
import hashlib
import hmac
from http.cookies import CookieError, SimpleCookie
from typing import Literal, Protocol

from starlette.datastructures import Headers

from svsa_server.access.class_keys import ClassKeys
from svsa_server.access.people import People
from svsa_server.access.roles import EVERYBODY, INSTRUCTOR, Person

COOKIE = "svsa_access"
REFUSAL_DELAY_S = 0.5

DoorKind = Literal["open", "secret", "class"]


class Door(Protocol):
    """Says who calls. kind: how one comes in. needed: what a stranger is told, kind and text.

    patience: what whoever gave a wrong secret waits for before the answer.
    """

    kind: DoorKind
    needed: tuple[str, str]
    patience: "Patience"

    def admit(self, headers: Headers) -> Person | None:
        """Who calls, or None for a stranger."""
        ...

    def log_in(self, secret: str) -> str | None:
        """The cookie for whoever knows the secret, or the instructor token; None for others."""
        ...


class Patience:
    """Wrong answers come one by one, half a second each."""

    def __init__(self) -> None:
        self._failures = asyncio.Lock()

    async def wait(self) -> None:
        """Until it is the turn of this wrong answer."""
        async with self._failures:
            await asyncio.sleep(REFUSAL_DELAY_S)


class OpenDoor:
    """A lab on loopback: whoever is on this machine is in."""

    kind: DoorKind = "open"
    needed: tuple[str, str] = ("", "")

    def __init__(self) -> None:
        self.patience = Patience()

    def admit(self, headers: Headers) -> Person | None:
        """Everybody."""
        return EVERYBODY

    def log_in(self, secret: str) -> str | None:
        """Everyone is in already."""
        return ""


class SecretDoor:
    """A lab with a shared secret, checked in constant time: as bearer token, or as cookie."""

    kind: DoorKind = "secret"
    needed: tuple[str, str] = (
        "secret_needed",
        "This lab needs its shared secret (bearer token or login).",
    )

    def __init__(self, secret: str) -> None:
        self._secret = secret.encode()
        self._cookie = hmac.new(self._secret, b"svsa access cookie", hashlib.sha256).hexdigest()
        self.patience = Patience()

    def admit(self, headers: Headers) -> Person | None:
        """Everybody who knows the secret."""
        if hmac.compare_digest(_read_cookie(headers).encode(), self._cookie.encode()):
            return EVERYBODY
        return EVERYBODY if self.log_in(read_bearer(headers)) is not None else None

    def log_in(self, secret: str) -> str | None:
        """The cookie that stands for the secret."""
        return self._cookie if hmac.compare_digest(secret.encode(), self._secret) else None


class ClassDoor:
    """A class: students join with a name and the code, the instructor has a token."""

    kind: DoorKind = "class"
    needed: tuple[str, str] = (
        "join_needed",
        "This lab is a class: join it with your name and the class code.",
    )

    def __init__(self, keys: ClassKeys, people: People) -> None:
        self.keys, self.people = keys, people
        self.patience = Patience()
        self._hashing = asyncio.Lock()

    def admit(self, headers: Headers) -> Person | None:
        """Whose cookie or token it is; what nobody signed counts as none."""
        token = read_bearer(headers)
        person = self.keys.read_person(token or _read_cookie(headers))
        if person is None and self.keys.is_instructor(token):
            person = INSTRUCTOR
        if person is not None:
            self.people.hear(person)
        return person

    def log_in(self, secret: str) -> str | None:
        """The instructor's cookie for the instructor token."""
        return self.keys.sign(INSTRUCTOR) if self.keys.is_instructor(secret.strip()) else None

    async def check_code(self, code: str) -> bool:
        """Whether it is the class code; one at a time, beside the event loop: it is hashed."""
        async with self._hashing:
            return await asyncio.to_thread(self.keys.is_code, code)


def _read_cookie(headers: Headers) -> str:
    cookies = SimpleCookie()
    try:
        cookies.load(headers.get("cookie", ""))
    except CookieError:
        return ""
    return cookies[COOKIE].value if COOKIE in cookies else ""


def read_bearer(headers: Headers) -> str:
    """The bearer token of a request, or an empty text."""
    scheme, _, token = headers.get("authorization", "").partition(" ")
    return token.strip() if scheme.lower() == "bearer" else ""

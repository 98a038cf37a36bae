"""Authentication: open on this machine, by a shared secret, or as a member of a class."""

import asyncio
import hashlib
import hmac
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from http.cookies import CookieError, SimpleCookie
from typing import Literal, Protocol, TypeVar
from weakref import WeakValueDictionary

from starlette.datastructures import Headers

from svsa_server.access.class_keys import ClassKeys, draw_rejoin_code
from svsa_server.access.memberships import Membership, Memberships
from svsa_server.access.people import People
from svsa_server.access.roles import ANY_USER, INSTRUCTOR, Person, Role

COOKIE = "svsa_access"
REFUSAL_DELAY_S = 0.5
REMOVED = "The instructor has removed you from the class."
T = TypeVar("T")

AuthenticationKind = Literal["open", "secret", "class"]


class Authentication(Protocol):
    """Identifies the caller of a request.

    Attributes:
        kind: Method of authentication.
        patience: Delays the answer to a wrong secret.
    """

    kind: AuthenticationKind
    patience: "Patience"

    def describe_needed(self, headers: Headers) -> tuple[str, str]:
        """The problem for an unauthenticated caller: its kind and its text."""
        ...

    def admit(self, headers: Headers) -> Person | None:
        """Return the caller, or None if unauthenticated."""
        ...

    def log_in(self, secret: str) -> str | None:
        """Return the cookie for the right secret or instructor token; None for any other."""
        ...


class Patience:
    """Delays answers to wrong secrets: half a second each, one at a time per address.

    Each address has its own lock, so that guesses from one do not delay answers to another.
    """

    def __init__(self) -> None:
        # Unused locks are garbage-collected, so that addresses do not accumulate.
        self._failures: WeakValueDictionary[str, asyncio.Lock] = WeakValueDictionary()

    async def wait(self, address: str) -> None:
        """Wait for this wrong answer's delay.

        Args:
            address: Network address of the client.
        """
        lock = self._failures.setdefault(address, asyncio.Lock())
        async with lock:
            await asyncio.sleep(REFUSAL_DELAY_S)


class OpenAuthentication:
    """A lab on loopback: every user of this machine has access."""

    kind: AuthenticationKind = "open"

    def __init__(self) -> None:
        self.patience = Patience()

    def describe_needed(self, headers: Headers) -> tuple[str, str]:
        """Return nothing: every caller is authenticated."""
        return "", ""

    def admit(self, headers: Headers) -> Person | None:
        """Admit every caller."""
        return ANY_USER

    def log_in(self, secret: str) -> str | None:
        """Return no cookie: every caller is authenticated."""
        return ""


class SecretAuthentication:
    """A lab with a shared secret, checked in constant time: as bearer token, or as cookie."""

    kind: AuthenticationKind = "secret"

    def __init__(self, secret: str) -> None:
        self._secret = secret.encode()
        self._cookie = hmac.new(self._secret, b"svsa access cookie", hashlib.sha256).hexdigest()
        self.patience = Patience()

    def describe_needed(self, headers: Headers) -> tuple[str, str]:
        """Ask for the secret."""
        return "secret_needed", "This lab needs its shared secret (bearer token or login)."

    def admit(self, headers: Headers) -> Person | None:
        """Admit every caller who sends the secret."""
        if hmac.compare_digest(_read_cookie(headers).encode(), self._cookie.encode()):
            return ANY_USER
        return ANY_USER if self.log_in(read_bearer(headers)) is not None else None

    def log_in(self, secret: str) -> str | None:
        """Return a cookie that replaces the secret."""
        return self._cookie if hmac.compare_digest(secret.encode(), self._secret) else None


class ClassAuthentication:
    """A class: students join with a name and the code, the instructor has a token.

    Cookies and tokens are valid until the instructor removes the user.
    """

    kind: AuthenticationKind = "class"

    def __init__(self, keys: ClassKeys, people: People, members: Memberships) -> None:
        self.keys, self.people, self.members = keys, people, members
        self.patience = Patience()
        # One thread: every thread that hashes keeps the 16 MB of scrypt.
        self._hashing = ThreadPoolExecutor(1, "class code")

    def admit(self, headers: Headers) -> Person | None:
        """Return the person of the cookie or token; None if unsigned, or if the person was
        removed.
        """
        carried, membership = self._read(headers)
        if carried == INSTRUCTOR or self.keys.is_instructor(read_bearer(headers)):
            person = INSTRUCTOR
        elif carried is None or membership is None or membership.is_ended:
            return None
        else:
            member = membership.person
            # The role of an earlier cookie is an upper bound: a promotion does not raise it, and a
            # demotion lowers it.
            person = member._replace(role=min(carried.role, member.role))
        self.people.hear(person)
        return person

    def is_removed(self, headers: Headers) -> bool:
        """Whether the instructor has removed the person of this cookie or token."""
        _, membership = self._read(headers)
        return membership is not None and membership.is_ended

    def describe_needed(self, headers: Headers) -> tuple[str, str]:
        """Ask the caller to join, or report the removal."""
        if self.is_removed(headers):
            return "removed", REMOVED
        return "join_needed", "This lab is a class: join it with your name and the class code."

    def log_in(self, secret: str) -> str | None:
        """Return the instructor's cookie for the instructor token."""
        return self.keys.sign(INSTRUCTOR) if self.keys.is_instructor(secret.strip()) else None

    async def check_code(self, code: str) -> bool:
        """Whether this is the class code."""
        return await self._hash(self.keys.is_code, code)

    async def join(self, name: str, role: Role) -> Person:
        """Add a new person to the class."""
        person = self.people.join(name, role)
        await asyncio.to_thread(self.members.keep, Membership(person))
        return person

    async def rejoin(self, rejoin_code: str) -> Membership | None:
        """Return the user of a rejoin code; the name may now have a number."""
        hashed = await self._hash(self.keys.hash_rejoin_code, rejoin_code)
        found = self.members.find_returning(hashed)
        if found is None or found.is_ended:
            return found
        person = self.people.enter(found.person)
        if person != found.person:
            found = found._replace(person=person)
            await asyncio.to_thread(self.members.keep, found)
        return found

    async def renew_rejoin_code(self, person: Person) -> str | None:
        """Create a rejoin code for this user; the previous one becomes invalid.

        None for a user without a membership, or with a lower role than its own.
        """
        found = self.members.find(person.id)
        if found is None or found.person != person:
            return None
        code = draw_rejoin_code()
        hashed = await self._hash(self.keys.hash_rejoin_code, code)
        await asyncio.to_thread(self.members.keep, found._replace(return_hash=hashed))
        return code

    async def set_removed(self, person_id: str, is_removed: bool) -> Person:
        """Remove a user at once, or restore one.

        Raises:
            UnknownError: If there is no such user.
        """
        person = await asyncio.to_thread(self.members.set_ended, person_id, is_removed)
        if is_removed:
            self.people.dismiss(person)
        return person

    def _read(self, headers: Headers) -> tuple[Person | None, Membership | None]:
        """Return the signed person with the current membership."""
        carried = self.keys.read_person(read_bearer(headers) or _read_cookie(headers))
        return carried, carried and self.members.find(carried.id)

    async def _hash(self, work: Callable[[str], T], code: str) -> T:
        """Hash one code at a time, outside the event loop.

        Always in the same thread, because each thread that hashes keeps 16 MB.
        """
        return await asyncio.get_running_loop().run_in_executor(self._hashing, work, code)


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

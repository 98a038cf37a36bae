"""Authentication: open on this machine, by a shared secret, or as a member of a class."""

import asyncio
import hashlib
import hmac
import secrets
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from http.cookies import CookieError, SimpleCookie
from typing import Literal, Protocol, TypeVar
from weakref import WeakValueDictionary

from starlette.datastructures import Headers

from svsa_server.access.class_keys import (
    ClassKeys,
    Credential,
    CredentialKind,
    draw_rejoin_code,
)
from svsa_server.access.memberships import Membership, Memberships
from svsa_server.access.people import People
from svsa_server.access.roles import ANY_USER, INSTRUCTOR, Person, Role

COOKIE = "svsa_access"
REFUSAL_DELAY_S = 0.5
REMOVED = "The instructor has removed you from the class."
LEFT = "You have left the class."
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
        """Return the problem for an unauthenticated caller: its kind and its text."""
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

    Cookies and tokens are valid until their user leaves, or the instructor removes the user.
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
        credential, membership = self._read(headers)
        if self.keys.is_instructor(read_bearer(headers)):
            person = INSTRUCTOR
        elif credential is None or not self.members.is_valid(*credential):
            return None
        elif membership is None:
            person = credential.person
        else:
            member = membership.person
            # The role of an earlier cookie is an upper bound: a promotion does not raise it, and a
            # demotion lowers it.
            person = member._replace(role=min(credential.person.role, member.role))
        self.people.hear(person)
        return person

    def is_removed(self, headers: Headers) -> bool:
        """Return whether the instructor has removed the person of this cookie or token."""
        _, membership = self._read(headers)
        return membership is not None and membership.is_ended

    def describe_needed(self, headers: Headers) -> tuple[str, str]:
        """Ask the caller to join, or report the removal."""
        if self.is_removed(headers):
            return "removed", REMOVED
        return "join_needed", "This lab is a class: join it with your name and the class code."

    def log_in(self, secret: str) -> str | None:
        """Return the instructor's cookie for the instructor token."""
        if not self.keys.is_instructor(secret.strip()):
            return None
        return self.keys.sign(INSTRUCTOR, secrets.token_hex(8), "cookie")

    def sign(self, person: Person, kind: CredentialKind = "cookie") -> str:
        """Sign a cookie or token of a member, which is valid until the member leaves."""
        membership = self.members.find(person.id)
        return self.keys.sign(person, membership.login if membership else "", kind)

    async def create_token(
        self, person: Person, headers: Headers, role: Role
    ) -> tuple[str, Person]:
        """Create a token for a script; return it with the script's identity.

        The script of an instructor is a member of its own, whose token ends with this login.
        """
        script = person._replace(role=role)
        if person.role is Role.INSTRUCTOR:
            credential, _ = self._read(headers)
            script = await self.join(
                f"{person.name}'s script", role, credential.login if credential else ""
            )
        return self.sign(script, "token"), script

    async def leave(self, person: Person, headers: Headers) -> None:
        """End the cookies, tokens and streams of this person."""
        credential, _ = self._read(headers)
        if credential is not None:
            await asyncio.to_thread(self.members.end_login, person, credential.login)
        self.people.dismiss(person)

    async def check_code(self, code: str) -> bool:
        """Whether this is the class code."""
        return await self._hash(self.keys.is_code, code)

    async def join(self, name: str, role: Role, made_by: str = "") -> Person:
        """Add a new person to the class; a name that looks like that of a member gets a number."""
        person = Person(f"p-{secrets.token_hex(6)}", name, role)
        person = await asyncio.to_thread(
            self.members.add, person, lambda number: f"{name} ({number})", made_by
        )
        self.people.hear(person)
        return person

    async def rejoin(self, rejoin_code: str) -> Membership | None:
        """Return the user of a rejoin code."""
        hashed = await self._hash(self.keys.hash_rejoin_code, rejoin_code)
        return self.members.find_returning(hashed)

    async def renew_rejoin_code(self, person: Person) -> str | None:
        """Create a rejoin code for this user; the previous one becomes invalid.

        None for a user without a membership, or with a lower role than its own.
        """
        membership = self.members.find(person.id)
        if membership is None or membership.person != person:
            return None
        return await self.renew_rejoin_code_of(person.id)

    async def renew_rejoin_code_of(self, person_id: str) -> str:
        """Create a rejoin code for a member; the previous one becomes invalid.

        Raises:
            UnknownError: If there is no such member.
        """
        membership = self.members.get(person_id)
        code = draw_rejoin_code()
        hashed = await self._hash(self.keys.hash_rejoin_code, code)
        await asyncio.to_thread(self.members.keep, membership._replace(return_hash=hashed))
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

    def _read(self, headers: Headers) -> tuple[Credential | None, Membership | None]:
        """Return the token or cookie with the current membership of its person."""
        token = read_bearer(headers)
        credential = (
            self.keys.read(token, "token")
            if token
            else self.keys.read(_read_cookie(headers), "cookie")
        )
        return credential, credential and self.members.find(credential.person.id)

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
    """Return the bearer token of a request; empty if it has none."""
    scheme, _, token = headers.get("authorization", "").partition(" ")
    return token.strip() if scheme.lower() == "bearer" else ""

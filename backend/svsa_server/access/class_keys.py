"""The class code and the instructor token: generated once, shown once, stored as hashes.

The code is short enough to be read from a projection, so its hash is slow (scrypt); the token is
256 random bits, for which a fast hash is sufficient. A cookie or bearer token contains name, role
and login with a signature, and is invalid in other labs and after its expiry.
"""

import base64
import hashlib
import hmac
import json
import os
import secrets
from pathlib import Path
from typing import Literal, NamedTuple, get_args

from itsdangerous import BadData, URLSafeTimedSerializer

from svsa.errors import SecurityError
from svsa.inputs.stored_file import read_json
from svsa_server.access.roles import Person, Role

FILE = "class.json"
LONGEST_SIGNED = 2000
SIGNED_AGE_S = 120 * 24 * 3600
_LETTERS = "ABCDEFGHJKMNPQRSTUVWXYZ23456789"  # no letters that can be confused
_CODE_LENGTH, _RETURN_CODE_LENGTH, _GROUP = 8, 12, 4
_TOKEN_PREFIX = "svsa-instructor-"  # noqa: S105
CredentialKind = Literal["cookie", "token"]
_KINDS: tuple[CredentialKind, ...] = get_args(CredentialKind)
_SCRYPT = {"n": 2**14, "r": 8, "p": 1}


class ShownOnce(NamedTuple):
    """Secrets that are shown once and stored as hashes only."""

    code: str
    instructor_token: str


class Credential(NamedTuple):
    """The content of a cookie or token: a person, and the login with which it ends."""

    person: Person
    login: str


class ClassKeys:
    """The secrets of a class, in a file that only this account can read.

    Raises:
        SecurityError: If the file cannot be used.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        try:
            kept = read_json(path)
            self._salt, self._code = (base64.b64decode(kept[name]) for name in ("salt", "code"))
            self._token = bytes.fromhex(kept["instructor_sha256"])
            self._key: str = kept["signing_key"]
        except (OSError, ValueError, KeyError, TypeError) as error:
            raise SecurityError(
                f"The keys of the class in {path} cannot be read ({error}): delete the file;"
                " the next start creates new keys."
            ) from None
        # Different keys: a token is invalid as a cookie, and a cookie as a token.
        self._signers = {
            kind: URLSafeTimedSerializer(self._key, salt=f"svsa {kind}") for kind in _KINDS
        }

    @classmethod
    def open(cls, folder: Path) -> tuple["ClassKeys", ShownOnce | None]:
        """Open the keys of the class in this folder; new ones are created and shown once."""
        path = folder / FILE
        shown = None
        if not path.exists():
            shown = ShownOnce(_draw_code(_CODE_LENGTH), _TOKEN_PREFIX + secrets.token_urlsafe(32))
            _write(
                path,
                {
                    **_hash_with_salt(shown.code),
                    "instructor_sha256": _digest(shown.instructor_token).hex(),
                    "signing_key": secrets.token_hex(32),
                },
            )
        return cls(path), shown

    def is_code(self, code: str) -> bool:
        """Whether this is the class code, however it is spaced; takes some 50 ms."""
        return hmac.compare_digest(_stretch(code, self._salt), self._code)

    def is_instructor(self, token: str) -> bool:
        """Return whether this is the instructor token."""
        return hmac.compare_digest(_digest(token), self._token)

    def renew_code(self) -> str:
        """Create a new class code; members stay, and the old code becomes invalid."""
        code = _draw_code(_CODE_LENGTH)
        hashed = _hash_with_salt(code)
        kept = read_json(self._path)
        _write(self._path, kept | hashed)
        self._salt, self._code = (base64.b64decode(hashed[name]) for name in ("salt", "code"))
        return code

    def hash_rejoin_code(self, code: str) -> bytes:
        """Hash a rejoin code; takes about 50 ms.

        The salt is that of the class and not of the user, because the code alone identifies the
        user.
        """
        return _stretch(code, self._key.encode())

    def sign(self, person: Person, login: str = "", kind: CredentialKind = "token") -> str:
        """Sign a person with the login that ends this cookie or token."""
        signed = [person.id, person.name, person.role.word, login]
        return str(self._signers[kind].dumps(signed))

    def read(self, signed: str, kind: CredentialKind) -> Credential | None:
        """Read a cookie or token; None if this class did not sign it as such, or it expired."""
        if not signed or len(signed) > LONGEST_SIGNED:
            return None
        try:
            id_, name, role, login = self._signers[kind].loads(signed, max_age=SIGNED_AGE_S)
            return Credential(Person(id_, name, Role[role.upper()]), login)
        except (BadData, ValueError, KeyError, TypeError, AttributeError):
            return None


def draw_rejoin_code() -> str:
    """Draw a rejoin code for one person: 59 random bits."""
    return _draw_code(_RETURN_CODE_LENGTH)


def _draw_code(length: int) -> str:
    drawn = "".join(secrets.choice(_LETTERS) for _ in range(length))
    return "-".join(drawn[at : at + _GROUP] for at in range(0, length, _GROUP))


def _hash_with_salt(code: str) -> dict[str, str]:
    salt = secrets.token_bytes(16)
    return {
        "salt": base64.b64encode(salt).decode(),
        "code": base64.b64encode(_stretch(code, salt)).decode(),
    }


def _stretch(code: str, salt: bytes) -> bytes:
    plain = "".join(letter for letter in code.upper() if letter.isalnum())
    return hashlib.scrypt(plain.encode(), salt=salt, **_SCRYPT)


def _digest(token: str) -> bytes:
    return hashlib.sha256(token.encode()).digest()


def _write(path: Path, kept: dict[str, str]) -> None:
    """Write a file atomically, readable by this account only."""
    partly = path.with_suffix(".part")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        partly.unlink(missing_ok=True)
        # The mode is set at creation: with a later `chmod` other accounts could read the file in
        # between.
        descriptor = os.open(partly, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
        with os.fdopen(descriptor, "w", encoding="utf-8") as file:
            json.dump(kept, file)
        partly.replace(path)
    except OSError as error:
        raise SecurityError(f"The keys of the class cannot be kept in {path}: {error}.") from None

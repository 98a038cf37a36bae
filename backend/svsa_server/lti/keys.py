"""Keys: the lab's private key for signatures, and the platforms' public keys for launches."""

import os
import time
from pathlib import Path
from typing import Any

import httpx
from joserfc.errors import JoseError
from joserfc.jwk import KeySet, RSAKey

from svsa.errors import ParameterError, Violation
from svsa_server.lti.launch_error import LaunchError

_USE: Any = {"use": "sig", "alg": "RS256"}
_KEPT_S = 3600.0
_MIN_S = 30.0


def open_key(path: Path) -> RSAKey:
    """Read the lab's private key; it is created, readable by this account only, if there is none.

    Raises:
        ParameterError: If the file contains no such key, or cannot be read or written.
    """
    try:
        if not path.exists():
            opened = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
            with os.fdopen(opened, "wb") as file:
                file.write(RSAKey.generate_key(2048, private=True).as_pem(private=True))
        key = RSAKey.import_key(path.read_bytes(), _USE)
    except (OSError, ValueError, JoseError) as error:
        raise ParameterError(Violation("key_file", path, "", f"an RSA key ({error})")) from None
    if not key.is_private:
        raise ParameterError(Violation("key_file", path, "", "a private RSA key"))
    key.ensure_kid()
    return key


class PlatformKeys:
    """Public keys of platforms by address; read again after an hour or for an unknown key."""

    def __init__(self, client: httpx.AsyncClient) -> None:
        self._client = client
        self._known: dict[str, tuple[float, KeySet]] = {}

    async def get(self, address: str, kid: str | None) -> KeySet:
        """Return the keys at an address.

        Raises:
            LaunchError: If they are unavailable.
        """
        now = time.monotonic()
        asked, keys = self._known.get(address, (-_KEPT_S, None))
        has_key = keys is not None and any(key.kid == kid for key in keys.keys)
        age = now - asked
        # An unknown key id may be a new key of the platform, or an attack: the lab requests the
        # keys again at most every 30 s.
        if keys is not None and age < (_KEPT_S if has_key else _MIN_S):
            return keys
        try:
            answer = (await self._client.get(address)).raise_for_status()
            keys = KeySet.import_key_set(answer.json())
        except (httpx.HTTPError, JoseError, ValueError, KeyError, TypeError, AttributeError):
            raise LaunchError("The platform's keys cannot be read: its keyset URL is wrong, or it"
                              " does not answer.") from None  # fmt: skip
        self._known[address] = now, keys
        return keys

"""The learning platforms in a TOML file, and the logins that they start."""

import secrets
import time
from collections import OrderedDict
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, NamedTuple
from urllib.parse import urlsplit

from pydantic import AfterValidator, Field

from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import Checked, Flag, quantity
from svsa.inputs.toml_file import read_toml
from svsa_server.config import is_loopback

LTI_FILE = "LTI file"


def check_address(address: str) -> str:
    """Check an address: https, or on this machine.

    Raises:
        ValueError: Otherwise.
    """
    parts = urlsplit(address)
    is_safe = parts.scheme == "https" and bool(parts.hostname)
    if not is_safe and not (parts.scheme == "http" and is_loopback(parts.hostname or "")):
        raise ValueError("an https address, or http on this machine")
    return address


Address = Annotated[str, Field(max_length=1000), AfterValidator(check_address)]
_Name = Annotated[str, Field(min_length=1, max_length=500)]


class Platform(Checked):
    """A platform: its identity and addresses.

    Attributes:
        deployments: Ids of deployments that may launch.
        takes_instructors: Whether an instructor of the platform is the instructor of the lab;
            otherwise all its users are students.
    """

    issuer: _Name = quantity("", "Who signs (Platform ID)")
    client_id: _Name = quantity("", "Id that it has given to this lab")
    deployments: tuple[_Name, ...] = quantity("", "Deployment ids", min_length=1, max_length=100)
    login_url: Address = quantity("", "Authentication request URL")
    token_url: Address = quantity("", "Access token URL")
    keyset_url: Address = quantity("", "Public keyset URL")
    takes_instructors: Flag = quantity("", "Whether instructors come as such", default=False)


class LtiSettings(Checked):
    """All platforms; `key_file` is the lab's private key (PEM), relative to the file, created if
    missing.
    """

    key_file: Path = quantity("", "Private key of the lab, PEM")
    platforms: tuple[Platform, ...] = quantity("", "Who may launch", min_length=1, max_length=100)

    def find(self, issuer: str, client_id: str | None) -> Platform | None:
        """Find the platform of an issuer; `client_id` is needed if the issuer has several."""
        matches = [platform for platform in self.platforms if platform.issuer == issuer]
        if client_id is not None:
            matches = [platform for platform in matches if platform.client_id == client_id]
        return matches[0] if len(matches) == 1 else None


def read_lti_file(path: Path) -> LtiSettings:
    """Read the settings of a file.

    Raises:
        ParameterError: If it is invalid, with its name.
    """
    values = read_toml(path, LTI_FILE)
    try:
        settings = LtiSettings(**values)
        keys = [(platform.issuer, platform.client_id) for platform in settings.platforms]
        if len(set(keys)) < len(keys):
            raise ParameterError(Violation("platforms", keys, "", "each issuer and client_id once"))
    except ParameterError as error:
        raise ParameterError(*error.violations, file=str(path)) from None
    return settings.changed(key_file=path.parent / settings.key_file)


LONGEST_S = 600.0
MAX_PENDING = 10_000


class Login(NamedTuple):
    """A started login; `begun` is monotonic time, s."""

    platform: Platform
    nonce: str
    begun: float


class Logins:
    """The started logins; the oldest are removed when there are too many."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._pending: OrderedDict[str, Login] = OrderedDict()

    def begin(self, platform: Platform) -> tuple[str, str]:
        """Start a login with a new state and nonce."""
        state, nonce = secrets.token_urlsafe(32), secrets.token_urlsafe(32)
        self._pending[state] = Login(platform, nonce, self._clock())
        if len(self._pending) > MAX_PENDING:
            self._pending.popitem(last=False)
        return state, nonce

    def end(self, state: str) -> Login | None:
        """End the login of a state; None if there is none or it expired."""
        login = self._pending.pop(state, None)
        is_late = login is not None and self._clock() - login.begun > LONGEST_S
        return None if is_late else login

"""Logins on their way: each has a state and a nonce, good once and for ten minutes."""

import secrets
import time
from collections import OrderedDict
from collections.abc import Callable
from typing import NamedTuple

from svsa_server.lti.platforms import Platform

LONGEST_S = 600.0
MAX_PENDING = 10_000


class Login(NamedTuple):
    """A login that was begun. begun: monotonic, s."""

    platform: Platform
    nonce: str
    begun: float


class Logins:
    """Those that were begun here; the oldest make room."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._pending: OrderedDict[str, Login] = OrderedDict()

    def begin(self, platform: Platform) -> tuple[str, str]:
        """A new state and nonce."""
        state, nonce = secrets.token_urlsafe(32), secrets.token_urlsafe(32)
        self._pending[state] = Login(platform, nonce, self._clock())
        if len(self._pending) > MAX_PENDING:
            self._pending.popitem(last=False)
        return state, nonce

    def end(self, state: str) -> Login | None:
        """The login of a state, which is used up by that; None where there is none, or too late."""
        login = self._pending.pop(state, None)
        is_late = login is not None and self._clock() - login.begun > LONGEST_S
        return None if is_late else login

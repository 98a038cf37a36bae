"""Rate limits: joins and wrong codes of an address, commands, sessions and runs of a person."""

import math
import time
from typing import Literal

from limits import RateLimitItem, parse
from limits.storage import MemoryStorage
from limits.strategies import MovingWindowRateLimiter

from svsa_server.leases.lease import CHANGING, STOPS

Kind = Literal["joins", "codes", "logins", "sessions", "runs", "commands"]
_KINDS: dict[str, Kind] = {
    "POST /api/v1/join": "joins",
    "POST /api/v1/rejoin": "joins",
    "POST /lti/login": "joins",
    "POST /lti/launch": "joins",
    "POST /sessions": "sessions",
    "POST /recording": "runs",
    "POST /excitation": "runs",
}
_STOPS = {f"{method} {path}" for method, path in STOPS}
_COUNTED_WHEN_WRONG = frozenset({"POST /api/v1/login"})
"""Only wrong instructor tokens count, so that guesses do not lock the instructor out."""

_WORDS: dict[Kind, str] = {"codes": "wrong class codes of a name", "logins": "wrong logins"}


def is_stop(method: str, path: str) -> bool:
    """Return whether a request pauses a session or stops it, which is never limited."""
    return f"{method} /{path.rpartition('/')[2]}" in _STOPS


def find_kind(method: str, path: str) -> Kind | None:
    """Return the kind of request for the rate limit; reading and stopping are not limited."""
    whole, last = f"{method} {path}", f"{method} /{path.rpartition('/')[2]}"
    if method not in CHANGING or is_stop(method, path) or whole in _COUNTED_WHEN_WRONG:
        return None
    return _KINDS.get(whole) or _KINDS.get(last, "commands")


class Rates:
    """The recent requests of all users. rates: of each kind, as "50/second"."""

    def __init__(self, rates: dict[Kind, str]) -> None:
        self._rates: dict[Kind, RateLimitItem] = {kind: parse(rate) for kind, rate in rates.items()}
        self._limiter = MovingWindowRateLimiter(MemoryStorage())

    def count(self, kind: Kind, who: str) -> int | None:
        """Count a request; return 0, or after how many seconds it would be allowed, at least 1."""
        if self._limiter.hit(self._rates[kind], kind, who):
            return None
        return self._find_wait(kind, who)

    def check(self, kind: Kind, who: str) -> int | None:
        """Return after how many seconds a request is allowed, without counting; None if now."""
        if self._limiter.test(self._rates[kind], kind, who):
            return None
        return self._find_wait(kind, who)

    def _find_wait(self, kind: Kind, who: str) -> int:
        free_at = self._limiter.get_window_stats(self._rates[kind], kind, who).reset_time
        return max(1, math.ceil(free_at - time.time()))

    def describe(self, kind: Kind, wait_s: int) -> str:
        """Why a request was rejected: the limit, and when to try again."""
        rate = self._rates[kind]
        limit = f"{rate.amount} {_WORDS.get(kind, kind)} per {rate.multiples}"
        return f"The limit of {limit} {rate.GRANULARITY.name} is reached: try again in {wait_s} s."

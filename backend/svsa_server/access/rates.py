"""How often one may: joins of an address, commands, sessions and runs of a person."""

import math
import time
from typing import Literal

from limits import RateLimitItem, parse
from limits.storage import MemoryStorage
from limits.strategies import MovingWindowRateLimiter

from svsa_server.leases.lease import CHANGING, STOPS

Kind = Literal["joins", "sessions", "runs", "commands"]
_KINDS: dict[str, Kind] = {
    "POST /api/v1/join": "joins",
    "POST /api/v1/return": "joins",
    "POST /api/v1/login": "joins",
    "POST /lti/login": "joins",
    "POST /lti/launch": "joins",
    "POST /sessions": "sessions",
    "POST /simulation": "sessions",
    "POST /branch": "sessions",
    "POST /recording": "runs",
    "POST /excitation": "runs",
}
_STOPS = {f"{method} {path}" for method, path in STOPS}


def find_kind(method: str, path: str) -> Kind | None:
    """What a request counts as; reading counts as nothing, and nor does stopping."""
    last = f"{method} /{path.rpartition('/')[2]}"
    if method not in CHANGING or last in _STOPS:
        return None
    return _KINDS.get(f"{method} {path}") or _KINDS.get(last, "commands")


class Rates:
    """What everybody has done lately. rates: of each kind, as "50/second"."""

    def __init__(self, rates: dict[Kind, str]) -> None:
        self._rates: dict[Kind, RateLimitItem] = {kind: parse(rate) for kind, rate in rates.items()}
        self._limiter = MovingWindowRateLimiter(MemoryStorage())

    def count(self, kind: Kind, who: str) -> int | None:
        """Count one more; where it is one too many, in how many seconds it is not, at least 1."""
        rate = self._rates[kind]
        if self._limiter.hit(rate, kind, who):
            return None
        free_at = self._limiter.get_window_stats(rate, kind, who).reset_time
        return max(1, math.ceil(free_at - time.time()))

    def describe(self, kind: Kind) -> str:
        """The rate in words, such as 50 commands per 1 second."""
        rate = self._rates[kind]
        return f"{rate.amount} {kind} per {rate.multiples} {rate.GRANULARITY.name}"

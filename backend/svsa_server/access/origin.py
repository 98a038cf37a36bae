"""Origin and host name of a request: pages of other sites are rejected.

A site may point its own name at this machine, and its pages then have the same origin as the lab.
So the lab answers to names that no other site can have: addresses, names of this machine, and
those of its configuration.
"""

import ipaddress
import socket
from urllib.parse import urlsplit

from starlette.datastructures import Headers
from starlette.types import Scope

from svsa_server.config import is_loopback

EVERYWHERE = ("0.0.0.0", "::")  # noqa: S104
_ELSEWHERE = ("192.0.2.1", 9)
"""An address that no machine has (RFC 5737): the way there begins at this machine's own."""


def is_same_origin(scope: Scope) -> bool:
    """Whether a request comes from the lab's own page, or not from a page at all."""
    headers = Headers(scope=scope)
    origin = headers.get("origin")
    if origin is None:
        return True
    try:
        return urlsplit(origin).netloc.lower() == headers.get("host", "").lower()
    except ValueError:
        # urlsplit rejects an unclosed bracket, as in http://[::1: no browser sends that.
        return False


def read_host(scope: Scope) -> str:
    """Return the host name of a request without its port; empty if it has none."""
    try:
        return urlsplit("//" + Headers(scope=scope).get("host", "")).hostname or ""
    except ValueError:
        return ""


def is_own_name(host: str, reported: frozenset[str]) -> bool:
    """Whether a lab that other machines reach serves this name. reported: its configured names."""
    if is_loopback(host) or host.lower() in reported | _find_own_names():
        return True
    try:
        ipaddress.ip_address(host)
    except ValueError:
        return False
    return True


def find_outward_address() -> str | None:
    """Find the machine's address in its network; None if it is in none. Nothing is sent."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as authentication:
        try:
            authentication.connect(_ELSEWHERE)
        except OSError:
            return None
        found = authentication.getsockname()[0]
    return None if is_loopback(found) else found


def _find_own_names() -> frozenset[str]:
    name = socket.gethostname().lower()
    return frozenset({name, name.partition(".")[0], f"{name.partition('.')[0]}.local"})

"""Origin and host name of a request: pages of other sites are rejected.

The name of another site can resolve to this machine, and its pages then have the same origin as the
lab. Therefore the lab only accepts host names that no other site can have: addresses, names of this
machine, and configured names.
"""

import ipaddress
import socket
from urllib.parse import urlsplit

from starlette.datastructures import Headers
from starlette.types import Scope

from svsa_server.config import is_loopback

EVERYWHERE = ("0.0.0.0", "::")  # noqa: S104
_ELSEWHERE = ("192.0.2.1", 9)
"""An address that no machine has (RFC 5737), used to find this machine's own address."""


def is_same_origin(scope: Scope) -> bool:
    """Return whether a request comes from the lab's own page, or from no page."""
    headers = Headers(scope=scope)
    origin = headers.get("origin")
    if origin is None:
        return True
    try:
        return urlsplit(origin).netloc.lower() == headers.get("host", "").lower()
    except ValueError:
        # urlsplit rejects an unclosed bracket, as in http://[::1, which no browser sends.
        return False


def read_host(scope: Scope) -> str:
    """Return the host name of a request without its port; empty if it has none."""
    try:
        return urlsplit("//" + Headers(scope=scope).get("host", "")).hostname or ""
    except ValueError:
        return ""


def is_own_name(host: str, configured: frozenset[str]) -> bool:
    """Return whether a lab that other machines can reach has this host name; `configured` are its
    configured names.
    """
    if is_loopback(host) or host.lower() in configured | _find_own_names():
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
        address = authentication.getsockname()[0]
    return None if is_loopback(address) else address


def _find_own_names() -> frozenset[str]:
    name = socket.gethostname().lower()
    return frozenset({name, name.partition(".")[0], f"{name.partition('.')[0]}.local"})

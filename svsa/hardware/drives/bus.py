"""The CAN bus of a bench, opened through python-can in a bounded time."""

import contextlib
import importlib
import logging
import socket
from collections.abc import Iterator
from typing import Any

import can

from svsa.errors import SvsaError
from svsa.hardware.bench.settings import BusSettings
from svsa.inputs.nearest import suggest

_ANSWER_S = 5.0
DELIVERY_S = 0.05
"""Time for which a bus stays open after the last frame, s: closing a socket may discard sent data.
"""


_ACKNOWLEDGEMENTS = 8
_SLCAN = "slcan"


_DRIVERS = {
    "gs_usb": "`pip install 'python-can[gs-usb]'` and the system's libusb (libusb-1.0-0)",
    "kvaser": "Kvaser's driver with CANlib (linuxcan on Linux, from kvaser.com)",
    "pcan": "PEAK's PCAN-Basic library (libpcanbasic, from peak-system.com)",
    "neovi": "`pip install 'python-can[neovi]'`",
    "canalystii": "`pip install 'python-can[canalystii]'`",
    "cantact": "`pip install 'python-can[cantact]'`",
    "ixxat": "HMS' VCI driver; it exists for Windows only",
    "vector": "Vector's XL driver library; it exists for Windows only",
}
"""Package to install if python-can has an interface without its driver."""
BUS_TROUBLE = (can.CanError, OSError, ValueError)
"""Exceptions of an open bus that is lost."""


class BusError(SvsaError):
    """A bus that cannot be opened or used. The message contains finding and advice.

    Attributes:
        finding: What failed.
        advice: What to do; "" if the cause is unknown.
    """

    def __init__(self, finding: str, advice: str = "") -> None:
        self.finding, self.advice = finding, advice
        super().__init__(f"{finding} {advice}".strip())


def open_bus(settings: BusSettings) -> can.BusABC:
    """Open the bus of a bench file.

    Adapters behind a socket get a timeout, because an adapter that accepts the connection and then
    does not answer would block indefinitely.

    Raises:
        BusError: If it cannot be opened, with the reason.
    """
    logging.getLogger("can").setLevel(logging.ERROR)
    # python-can's back ends open their own sockets: only the default timeout affects them.
    before = socket.getdefaulttimeout()
    socket.setdefaulttimeout(_ANSWER_S)
    try:
        _ask_for_server(settings)
        return can.Bus(
            interface=settings.interface,
            channel=settings.channel,
            bitrate=settings.bitrate,
            **_choose_options(settings),
        )
    except Exception as error:  # a missing driver raises exceptions of any kind, even NameError
        raise _describe_failure(settings, error) from None
    finally:
        socket.setdefaulttimeout(before)


def _describe_failure(settings: BusSettings, error: Exception) -> BusError:
    name, driver = settings.interface, _DRIVERS.get(settings.interface)
    if name not in can.VALID_INTERFACES:
        known = f"python-can has {', '.join(sorted(can.VALID_INTERFACES))}"
        nearest = suggest(name, can.VALID_INTERFACES)
        return BusError(
            f"The CAN bus cannot be opened: bus.interface is {name!r}, {known}{nearest}.",
            "Set interface in [bus] to one of them.",
        )
    is_missing = isinstance(error, NameError | ImportError | can.CanInterfaceNotImplementedError)
    reason = "its driver is not installed" if driver and is_missing else str(error).rstrip(".")
    needed = f" It needs {driver}." if driver else ""
    return BusError(
        f"The CAN bus {name} {settings.channel} cannot be opened: {reason}.{needed}",
        advise_on_adapter(settings),
    )


def advise_on_adapter(settings: BusSettings) -> str:
    """Advise on a bus that does not open, or is lost."""
    if settings.interface == "socketcand":
        host, port = (settings.options.get(name, "(not given)") for name in ("host", "port"))
        return (
            f"Check that a socketcand server runs at host {host}, port {port} (options of [bus]),"
            f" and that it serves {settings.channel}: start `socketcand` there, or `svsa emulator`"
            " for the emulated bench."
        )
    if settings.interface == "socketcan":
        return (
            f"Check that the adapter is plugged in, that its name {settings.channel} is right, and"
            f" that its interface is up: `ip link set {settings.channel} up type can bitrate"
            f" {settings.bitrate}`."
        )
    return (
        "Check that the adapter is plugged in, that its driver is installed, that its channel"
        f" {settings.channel} is right, and that no other program uses it."
    )


def prepare_bus(settings: BusSettings) -> None:
    """Import everything needed to open this bus, so that opening is fast later."""
    if settings.interface in can.interfaces.BACKENDS:
        with contextlib.suppress(ImportError, OSError):
            importlib.import_module(can.interfaces.BACKENDS[settings.interface][0])


def _ask_for_server(settings: BusSettings) -> None:
    """Raise `OSError` if nothing listens: python-can's socketcand would retry forever."""
    host, port = settings.options.get("host"), settings.options.get("port")
    if settings.interface == "socketcand" and host and port:
        socket.create_connection((host, port)).close()


def _choose_options(settings: BusSettings) -> dict[str, Any]:
    """Choose options as written; for slcan without a wait of 1 ms, which is a complete tick."""
    options: dict[str, Any] = {"timeout": 0.0} if settings.interface == _SLCAN else {}
    if settings.fd:
        options |= {"fd": True, "data_bitrate": settings.data_bitrate}
    return options | settings.options


def take_waiting(bus: can.BusABC, settings: BusSettings, most: int) -> Iterator[can.Message]:
    """Read at most `most` waiting messages.

    An slcan adapter acknowledges every command, for which python-can returns None: with such an
    adapter several None in a row mean the end.
    """
    patience = nothings = _ACKNOWLEDGEMENTS if settings.interface == _SLCAN else 1
    for _ in range(most):
        message = bus.recv(0)
        if message is not None:
            nothings = patience
            yield message
        elif (nothings := nothings - 1) == 0:
            return

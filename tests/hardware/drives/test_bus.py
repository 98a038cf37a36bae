"""A CAN bus that cannot be opened: the reason, what to install, within bounded time."""

import re
import socket
import threading

import can
import pytest

from svsa.hardware.bench.settings import BusSettings
from svsa.hardware.drives import bus as bus_module
from svsa.hardware.drives.bus import BusError, open_bus


def test_unknown_interfaces_and_invalid_options_are_errors_of_the_bus():
    for options in ({"interface": "nonesuch"}, {"interface": "socketcand", "options": {"x": 1}}):
        with pytest.raises(BusError, match="cannot be opened"):
            open_bus(BusSettings(**{"channel": "can0", **options}))


def test_advice_fits_the_interface():
    """A server that does not respond is not a disconnected adapter."""
    with socket.socket() as silent, pytest.raises(BusError) as caught:
        silent.bind(("127.0.0.1", 0))
        port = silent.getsockname()[1]
        options = {"host": "127.0.0.1", "port": port}
        open_bus(BusSettings(interface="socketcand", channel="can0", options=options))
    assert "refused" in caught.value.finding
    assert f"host 127.0.0.1, port {port}" in caught.value.advice
    assert "plugged" not in str(caught.value)
    with pytest.raises(BusError, match="the nearest is socketcand"):
        open_bus(BusSettings(interface="socketcandd", channel="can0"))
    with pytest.raises(BusError, match="ip link set nocan0 up"):
        open_bus(BusSettings(interface="socketcan", channel="nocan0"))


@pytest.mark.parametrize(
    ("interface", "package", "raised"),
    [
        ("kvaser", "driver is not installed. It needs Kvaser's driver with CANlib", NameError("x")),
        ("gs_usb", "pip install 'python-can[gs-usb]'", can.CanInterfaceNotImplementedError("usb")),
        ("gs_usb", "No backend available. It needs", ValueError("No backend available")),
        ("pcan", "libpcanbasic", OSError("PCANBasic library not found.")),
    ],
)
def test_interface_without_its_driver_names_what_to_install(
    monkeypatch, interface, package, raised
):
    """python-can's kvaser raises a NameError without CANlib."""

    def fail(**_):
        raise raised

    monkeypatch.setattr(can, "Bus", fail)
    with pytest.raises(BusError, match=re.escape(package)):
        open_bus(BusSettings(interface=interface, channel="0"))


def test_silent_daemon_is_not_waited_for(monkeypatch):
    monkeypatch.setattr(bus_module, "_ANSWER_S", 0.2)
    with socket.create_server(("127.0.0.1", 0)) as server:
        options = {"host": "127.0.0.1", "port": server.getsockname()[1]}
        settings = BusSettings(interface="socketcand", channel="can0", options=options)
        failures = []

        def open_it():
            try:
                open_bus(settings)
            except BusError as error:
                failures.append(error)

        opening = threading.Thread(target=open_it, daemon=True)
        opening.start()
        opening.join(30.0)
        assert len(failures) == 1

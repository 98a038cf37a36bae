"""Frames between the clients of python-can, over sockets and a terminal."""

import queue
import select
import threading
import time

import can
import pytest

from svsa.hardware.bench.emulation import EMULATED_ID, Frame
from svsa.hardware.emulator.slcan import SlcanServer
from svsa.hardware.emulator.socketcand import SocketcandServer

from .wire_frames import DATA, FRAMES, GREETING

HANG_S = 30.0
EMULATOR_TIME_S = 1234.000567


class Bus:
    """A bus with client frames only: each frame is sent to all other clients."""

    def __init__(self):
        self.socketcand, self.slcan = SocketcandServer(), SlcanServer()
        self.to_say: queue.Queue[Frame] = queue.Queue()
        self.heard: list[Frame] = []
        self.chatter = False
        self._stop = False
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def _run(self):
        servers = (self.socketcand, self.slcan)
        while not self._stop:
            waits = [wait for server in servers if (wait := server.wait_s()) is not None]
            sources = [source for server in servers for source in server.sources()]
            select.select(sources, [], [], 0.0 if self.chatter else min([0.01, *waits]))
            heard = [each for server in servers for each in server.poll()]
            for server in servers:
                for client in server.take_arrivals():
                    server.send(GREETING, EMULATOR_TIME_S, to=client)
            for client, frame in heard:
                self.heard.append(frame)
                for server in servers:
                    server.send(frame, EMULATOR_TIME_S, but=client)
            while not self.to_say.empty():
                frame = self.to_say.get()
                for server in servers:
                    server.send(frame, EMULATOR_TIME_S)
            if self.chatter:
                self.socketcand.send(Frame(0x01B, DATA), EMULATOR_TIME_S)

    def connect(self):
        return can.Bus(
            interface="socketcand", host="127.0.0.1", port=self.socketcand.port, channel="rig"
        )

    def plug_in(self, **options):
        return can.Bus(interface="slcan", channel=self.slcan.path, sleep_after_open=0.0, **options)

    def close(self):
        self._stop = True
        self._thread.join(HANG_S)
        assert not self._thread.is_alive()
        self.socketcand.close()
        self.slcan.close()


@pytest.fixture
def bus():
    running = Bus()
    yield running
    running.close()


def receive(client):
    """Return the next message; slcan also returns acknowledgements, which are skipped."""
    deadline = time.monotonic() + HANG_S
    while time.monotonic() < deadline:
        if (message := client.recv(0.1)) is not None:
            return message
    raise AssertionError("nothing was heard")


def receive_frame(client):
    message = receive(client)
    return Frame(
        message.arbitration_id, bytes(message.data), message.is_extended_id, message.is_error_frame
    )


def say(client, frame):
    client.send(
        can.Message(arbitration_id=frame.can_id, data=frame.data, is_extended_id=frame.extended)
    )


def test_each_client_of_python_can_receives_frames_of_others_only(bus):
    clients = [bus.connect() for _ in range(3)] + [bus.plug_in(bitrate=1_000_000)]
    for client in clients:
        assert receive_frame(client) == GREETING
    for sender in clients:
        for frame in FRAMES:
            say(sender, frame)
        for other in clients:
            if other is not sender:
                assert [receive_frame(other) for _ in FRAMES] == FRAMES
    end = Frame(0x321, b"end")
    bus.to_say.put(end)
    for client in clients:
        assert receive_frame(client) == end, "a client heard itself"
        client.shutdown()
    assert bus.heard == FRAMES * len(clients)


def test_frame_has_the_time_of_the_rig_to_the_microsecond(bus):
    client = bus.connect()
    assert receive(client).timestamp == pytest.approx(EMULATOR_TIME_S, abs=1e-9)
    client.shutdown()


def test_bus_error_is_an_error_frame(bus):
    client, adapter = bus.connect(), bus.plug_in()
    assert receive_frame(client) == receive_frame(adapter) == GREETING
    bus.to_say.put(Frame(0x020, b"", error=True))
    message = receive(client)
    assert message.is_error_frame
    assert message.timestamp == pytest.approx(EMULATOR_TIME_S)
    bus.to_say.put(Frame(0x123, DATA))
    assert receive_frame(adapter) == Frame(0x123, DATA), "slcan has no error frames"
    client.shutdown()
    adapter.shutdown()


def test_clients_connect_and_disconnect_on_a_busy_bus(bus):
    """A frame right after the handshake's `< ok >` would be read as part of it."""
    bus.chatter = True
    for _ in range(5):
        client = bus.connect()
        assert receive_frame(client).can_id in (EMULATED_ID, 0x01B)
        assert receive_frame(client).can_id == 0x01B
        client.shutdown()


def test_adapter_identifies_itself_to_python_can(bus):
    adapter = bus.plug_in(bitrate=1_000_000)
    assert adapter.get_version(HANG_S) == (10, 13)
    assert adapter.get_serial_number(HANG_S) == "SVSA"
    adapter.shutdown()


def test_remote_frame_is_ignored(bus):
    for client in (bus.connect(), bus.plug_in()):
        client.send(
            can.Message(arbitration_id=0x01F, is_remote_frame=True, dlc=8, is_extended_id=False)
        )
        say(client, FRAMES[0])
        assert receive_frame(client) == GREETING
        client.shutdown()
    deadline = time.monotonic() + HANG_S
    while len(bus.heard) < 2 and time.monotonic() < deadline:
        time.sleep(0.01)
    assert bus.heard == [FRAMES[0]] * 2

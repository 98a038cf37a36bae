"""The emulator as a process: its ready line, its control port, lockstep over a real socket."""

import json
import socket
import subprocess
import sys
import time

import pytest

from svsa.hardware.bench.emulation import ADVANCE_ID, EMULATED_ID, encode_time
from svsa.hardware.emulator.control import EmulatorError
from svsa.hardware.emulator.faults import Silence
from svsa.hardware.emulator.launch import start_emulator
from svsa.simulation.plant.loads.constant import ConstantLoad
from svsa.simulation.plant.loads.mass import MassLoad

HANG_S = 240.0


class Wire:
    """A minimal socketcand client, which tests the emulator without the plant of the lab."""

    def __init__(self, port):
        self._socket = socket.create_connection(("127.0.0.1", port), HANG_S)
        self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._text = ""
        assert self.read() == ["hi"]
        for command in ("open rig", "rawmode"):
            self._socket.sendall(f"< {command} >".encode())
            assert self.read() == ["ok"]

    def read(self):
        while ">" not in self._text:
            chunk = self._socket.recv(65536)
            assert chunk, "the emulator has closed the connection"
            self._text += chunk.decode()
        head, _, self._text = self._text.partition(">")
        return head.strip("< ").split()

    def send(self, *frames):
        """Send identifiers and data of frames in one write."""
        text = ""
        for can_id, data in frames:
            name = f"{can_id:08X}" if can_id > 0x7FF else f"{can_id:03X}"
            text += f"< send {name} {len(data)} {data.hex(' ').upper()} >"
        self._socket.sendall(text.encode())

    def advance(self, time_us, *before):
        """Send frames and request this time; return everything received until the echo."""
        self.send(*before, (ADVANCE_ID, encode_time(time_us)))
        said = []
        while True:
            words = self.read()
            said.append(words)
            if words[1] == f"{ADVANCE_ID:08X}":
                assert int(words[3], 16) == time_us
                return said

    def close(self):
        self._socket.close()


@pytest.fixture(scope="module")
def only_emulator():
    with start_emulator(lockstep=True) as running:
        yield running


@pytest.fixture
def emulator(only_emulator):
    """The emulator of this module, at its marks, without load or fault; its time continues."""
    only_emulator.control.clear_faults()
    only_emulator.control.set_loads(())
    only_emulator.control.home()
    return only_emulator


def read_time_us(emulator):
    return round(1e6 * emulator.control.read_state()["time_s"])


def test_time_in_lockstep_advances_on_request_only(emulator):
    wire = Wire(emulator.port)
    begin = read_time_us(emulator)
    time.sleep(0.05)
    assert read_time_us(emulator) == begin
    said = wire.advance(begin + 10_000)
    assert sum(words[1] == "700" for words in said) == 10
    assert read_time_us(emulator) == begin + 10_000
    emulation = {f"{ADVANCE_ID:08X}", f"{EMULATED_ID:08X}"}
    assert {words[1] for words in wire.advance(begin + 10_000)} <= emulation
    assert read_time_us(emulator) == begin + 10_000
    wire.close()


@pytest.mark.exhaustive
def test_lockstep_over_the_socket_is_reproducible_to_the_byte():
    def record():
        with start_emulator(lockstep=True) as running:
            wire = Wire(running.port)
            said = []
            wire.send((0x000, b"\x55" * 8))
            said += wire.advance(600_000)
            for number in (1, 2):
                wire.send((number << 4 | 0xA, b"\x01\x00" + b"\x55" * 6))
                wire.send((number << 4 | 0x1, b"\x02" + b"\x55" * 7))
            said += wire.advance(1_200_000)
            for tick in range(1, 100):
                for number in (1, 2):
                    current = (400 if tick // 20 % 2 else -400).to_bytes(2, "big", signed=True)
                    wire.send((number << 4 | 0x3, b"\x13\x88" + current + b"\x55" * 4))
                said += wire.advance(1_200_000 + 1000 * tick)
            wire.close()
            return said

    first, second = record(), record()
    assert first == second
    assert len(first) > 1500


@pytest.mark.parametrize("together", [True, False])
def test_client_is_greeted_before_its_first_frame_acts(emulator, together):
    """For any split of its frames: otherwise two runs in lockstep would differ."""
    wire = Wire(emulator.port)
    begin = read_time_us(emulator)
    reset = (0x000, b"\x55" * 8)
    if together:
        said = wire.advance(begin + 5_000, reset)
    else:
        wire.send(reset)
        said = wire.advance(begin + 5_000)
    assert said[0][1:3] == [f"{EMULATED_ID:08X}", f"{1e-6 * begin:.6f}"]
    wire.close()


def test_client_is_notified_of_the_emulation(emulator):
    wire = Wire(emulator.port)
    assert f"{EMULATED_ID:08X}" in {
        words[1] for words in wire.advance(read_time_us(emulator) + 150_000)
    }
    wire.close()


def test_loads_and_faults_are_set_over_the_control_port(emulator):
    begin = read_time_us(emulator)
    emulator.control.load(MassLoad())
    emulator.control.load(ConstantLoad(torque_nm=(2.0, 0.0, 0.0)), at_s=1e-6 * begin + 0.05)
    emulator.control.fault(Silence(node="motor1"), at_s=1e-6 * begin + 0.02)
    wire = Wire(emulator.port)
    wire.advance(begin + 10_000)
    assert emulator.control.read_state()["drives"]["motor1"]["powered"]
    wire.advance(begin + 30_000)
    state = emulator.control.read_state()
    assert not state["drives"]["motor1"]["powered"]
    assert state["x"]["q"] == 0.0
    wire.advance(begin + 80_000)
    assert emulator.control.read_state()["x"]["q"] > 0.01
    wire.close()


def test_invalid_request_on_the_control_port_is_answered_with_the_reason(emulator):
    lines = (
        b"nonsense",
        b"[]",
        b"{}",
        b'{"do": "explode"}',
        b'{"do": "load"}',
        b'{"do": "load", "load": {"kind": "mass"}, "at_s": "soon"}',
        b'{"do": "fault", "fault": {"kind": "stall", "node": "deflection"}}',
        b"\xff\xfe",
    )
    begin = read_time_us(emulator)
    with socket.create_connection(("127.0.0.1", emulator.control_port), HANG_S) as client:
        answers = client.makefile()
        for line in lines:
            client.sendall(line + b"\n")
            reported = json.loads(answers.readline())
            assert reported["ok"] is False, line
            assert reported["message"], line
    with pytest.raises(EmulatorError):
        emulator.control.ask("explode")
    assert read_time_us(emulator) == begin


@pytest.mark.exhaustive
def test_time_against_the_clock_advances_automatically():
    with start_emulator(lockstep=False) as running:
        deadline = time.monotonic() + HANG_S
        while running.control.read_state()["time_s"] < 0.1:
            assert time.monotonic() < deadline


@pytest.mark.exhaustive
def test_time_in_lockstep_advances_without_a_loop_until_one_connects():
    with start_emulator(True, 120.0, "--alone-s", "0.2") as running:
        loop = Wire(running.port)
        assert read_time_us(running) == 0, "no user has asked yet"
        loop.advance(5_000)
        deadline = time.monotonic() + HANG_S
        while read_time_us(running) < 100_000:
            assert time.monotonic() < deadline
        loop.send((ADVANCE_ID, encode_time(5_000)))
        while (words := loop.read())[1] != f"{ADVANCE_ID:08X}":
            pass
        assert int(words[3], 16) >= 100_000, "it does not go back"
        loop.close()


@pytest.mark.exhaustive
def test_emulator_ends_on_request_and_when_idle():
    with start_emulator(lockstep=True) as running:
        process = running.process
    assert process.returncode == 0
    # Without a connection of the test, which on a busy machine may take longer than it is idle.
    command = [sys.executable, "-m", "svsa.hardware.emulator.cli", "--lockstep", "--idle-s", "0.3"]
    ports = ["--port", "0", "--control-port", "0"]
    done = subprocess.run([*command, *ports], stdout=subprocess.PIPE, timeout=HANG_S)
    assert done.returncode == 0

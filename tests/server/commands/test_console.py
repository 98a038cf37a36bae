"""The quick stop on the keyboard of the console."""

import os
import sys
import threading

import pytest

from svsa_server.commands.console import KEYS, watch_keyboard

WAIT_S = 10.0


@pytest.fixture
def keyboard(monkeypatch: pytest.MonkeyPatch):
    """A terminal as standard input; text written to it is typed."""
    keys, terminal = os.openpty()
    with os.fdopen(terminal) as stream:
        monkeypatch.setattr(sys, "stdin", stream)
        yield keys
    os.close(keys)


@pytest.mark.parametrize("key", [bytes([key]) for key in KEYS] + [b"E"])
def test_key_stops_the_session(keyboard: int, key: bytes) -> None:
    pressed = threading.Event()
    with watch_keyboard(pressed.set) as watched:
        assert watched
        os.write(keyboard, b"xyz")
        assert not pressed.wait(0.3)
        os.write(keyboard, key)
        assert pressed.wait(WAIT_S)


def test_terminal_settings_are_restored(keyboard: int) -> None:
    import termios

    before = termios.tcgetattr(sys.stdin.fileno())
    with watch_keyboard(lambda: None):
        assert termios.tcgetattr(sys.stdin.fileno()) != before
    assert termios.tcgetattr(sys.stdin.fileno()) == before


def test_no_keys_are_read_without_a_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    with open(os.devnull) as nothing:  # noqa: PTH123
        monkeypatch.setattr(sys, "stdin", nothing)
        with watch_keyboard(lambda: None) as watched:
            assert not watched

"""A TCP connection between a script and a lab on loopback that breaks on command."""

import contextlib
import socket
import threading
from collections.abc import Iterator
from urllib.parse import urlsplit


class FaultyLine:
    """Carries bytes both ways. break_requests: of how many calls nothing more reaches the lab.

    break_answers: the number of changing calls whose answer is lost on its way back.
    """

    def __init__(self, lab_url: str) -> None:
        self._lab = ("127.0.0.1", urlsplit(lab_url).port)
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.url = f"http://127.0.0.1:{self._listener.getsockname()[1]}"
        self.break_requests = self.break_answers = 0
        self._open: list[socket.socket] = []
        self._losing: set[socket.socket] = set()
        threading.Thread(target=self._accept, daemon=True).start()

    def cut(self) -> None:
        """Close every open connection; new ones are accepted."""
        _shut(*self._open)
        self._open.clear()

    def close(self) -> None:
        self._listener.close()
        self.cut()

    def _accept(self) -> None:
        with contextlib.suppress(OSError):
            while True:
                near, _ = self._listener.accept()
                far = socket.create_connection(self._lab)
                self._open += (near, far)
                threading.Thread(target=self._carry_up, args=(near, far), daemon=True).start()
                threading.Thread(target=self._carry, args=(far, near), daemon=True).start()

    def _carry_up(self, near: socket.socket, far: socket.socket) -> None:
        with contextlib.suppress(OSError):
            while data := near.recv(65536):
                changes = data.startswith((b"PUT", b"POST", b"DELETE", b"PATCH"))
                if changes and self.break_requests:
                    self.break_requests -= 1
                    break
                if changes and self.break_answers:
                    self.break_answers -= 1
                    self._losing.add(far)
                far.sendall(data)
            _shut(near, far)

    def _carry(self, far: socket.socket, near: socket.socket) -> None:
        with contextlib.suppress(OSError):
            while (data := far.recv(65536)) and far not in self._losing:
                near.sendall(data)
            _shut(near, far)


def _shut(*ends: socket.socket) -> None:
    for end in ends:
        with contextlib.suppress(OSError):
            end.shutdown(socket.SHUT_RDWR)


@contextlib.contextmanager
def run_faulty_line(lab_url: str) -> Iterator[FaultyLine]:
    line = FaultyLine(lab_url)
    try:
        yield line
    finally:
        line.close()

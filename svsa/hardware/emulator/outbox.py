"""What a client has still to be said: nothing is lost while it reads, nobody waits while not."""

from collections.abc import Callable

MAX_BYTES = 8 * 2**20
FULL_BYTES = 16_384
RETRY_S = 0.002


class Outbox:
    """Keeps what is said, in order, for `flush`: many short texts go in one write.

    write: a non-blocking write of some of the bytes, as `os.write`; how many went.
    """

    def __init__(self, write: Callable[[bytes | bytearray], int]) -> None:
        self._write = write
        self._kept = bytearray()

    @property
    def wait_s(self) -> float | None:
        """When to `flush` again; None where nothing is kept."""
        return RETRY_S if self._kept else None

    def push(self, text: bytes) -> None:
        """Say this. Raises `OSError` for a client that has left, or has long read nothing."""
        if len(self._kept) + len(text) > MAX_BYTES:
            raise ConnectionError("the client does not read")
        self._kept += text
        if len(self._kept) >= FULL_BYTES:
            self.flush()

    def flush(self) -> None:
        """Say what was kept, as far as it goes. Raises `OSError` for a client that has left."""
        try:
            while self._kept:
                del self._kept[: self._write(self._kept)]
        except BlockingIOError:
            return

    def clear(self) -> None:
        """Forget what was kept."""
        self._kept.clear()

"""A filter of log handlers: one record per second for a repeated error."""

import logging
import re
import threading
import time

PERIOD_S = 1.0
MAX_STORED = 256
_NUMBER = re.compile(r"0x[0-9a-f]+|\d+")


class RepeatedErrors(logging.Filter):
    """Drops a warning or error that a second ago was already logged; the next one counts them.

    Records are the same if their texts differ in numbers only, and their exceptions were raised at
    the same place.
    """

    def __init__(self) -> None:
        super().__init__()
        self._lock = threading.Lock()
        self._logged: dict[tuple[str, ...], tuple[float, int]] = {}
        """Time of the last record of each kind, and number of those dropped since."""

    def filter(self, record: logging.LogRecord) -> bool:
        """Return whether the record is logged."""
        if record.levelno < logging.WARNING:
            return True
        key, now = _identify(record), time.monotonic()
        with self._lock:
            logged_s, dropped = self._logged.pop(key, (-PERIOD_S, 0))
            if now - logged_s < PERIOD_S:
                self._logged[key] = (logged_s, dropped + 1)
                return False
            self._logged[key] = (now, 0)
            if len(self._logged) > MAX_STORED:
                del self._logged[next(iter(self._logged))]
        if dropped:
            record.msg = f"{record.getMessage().rstrip()} ({dropped} more since the last one)"
            record.args = None
        return True


def limit_repeated_errors() -> None:
    """Filter every handler that writes logs of the server and its libraries."""
    repeated = RepeatedErrors()
    handlers = {*logging.getLogger().handlers, *logging.getLogger("uvicorn").handlers}
    if logging.lastResort is not None:
        handlers.add(logging.lastResort)
    for handler in handlers:
        handler.addFilter(repeated)


def _identify(record: logging.LogRecord) -> tuple[str, ...]:
    place = ""
    if record.exc_info and record.exc_info[2]:
        frames = record.exc_info[2]
        while frames.tb_next is not None:
            frames = frames.tb_next
        place = f"{record.exc_info[0]} {frames.tb_frame.f_code.co_filename} {frames.tb_lineno}"
    return record.name, _NUMBER.sub("#", record.getMessage()), place

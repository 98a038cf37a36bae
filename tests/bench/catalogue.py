"""`python -m tests.bench.catalogue`: how long a page of 10,000 runs takes to list."""

import dataclasses
import statistics
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

from svsa.runtime.catalogue.database import Database
from svsa.runtime.catalogue.entry import RunEntry
from svsa.runtime.catalogue.runs import Catalogue
from svsa.runtime.metrics import Metrics

RUNS = 10_000
REPEATS = 30
MARK_MS = 100.0
METRICS = Metrics(60.0, 1e-3, 2e-3, 1e-2, 2e-2, 3.0, 0.4, 0.05, 120.0, 1.25)


def fill(folder: Path) -> None:
    """Put 10,000 runs with names, tags, notes and metrics of two lanes into a catalogue."""
    run = RunEntry(
        id="",
        created="",
        notes="Three kilograms at 5 s, then the hand. " * 5,
        session="lab",
        version="0.1.0",
        state="complete",
        lanes=("ndobc", "fl"),
        period_s=0.001,
        ticks=60_000,
        duration_s=60.0,
        bytes=12_000_000,
        metrics=(METRICS, METRICS),
    )
    Database(folder / "catalogue.sqlite").put(
        *(
            dataclasses.replace(
                run,
                id=f"run-{number:05}",
                created=f"2026-01-{1 + number % 28:02}T{number % 24:02}:00:00+00:00",
                name=f"Group {number % 40} attempt {number}",
                tags=("class", f"group-{number % 40}"),
            )
            for number in range(RUNS)
        )
    )


def measure(call: Callable[[], object]) -> tuple[float, float]:
    """Median and greatest wall time of a call, ms."""
    times = []
    for _ in range(REPEATS):
        begin = time.perf_counter()
        call()
        times.append((time.perf_counter() - begin) * 1e3)
    return statistics.median(times), max(times)


def main() -> None:
    """Print what every way to list costs."""
    with tempfile.TemporaryDirectory() as folder:
        catalogue = Catalogue(folder)
        fill(Path(folder))
        pages = {
            "the first page": lambda: catalogue.list(),
            "the last page": lambda: catalogue.list(page=RUNS // 50),
            "200 runs by name": lambda: catalogue.list(sort="name", page_size=200),
            "a search": lambda: catalogue.list(search="group attempt 99"),
            "a tag": lambda: catalogue.list(tag="group-7"),
            "a search with a tag": lambda: catalogue.list(search="hand", tag="class"),
            "all tags": lambda: catalogue.list_tags(),
        }
        for name, call in pages.items():
            median, greatest = measure(call)
            mark = "" if greatest < MARK_MS else f"   more than {MARK_MS:g} ms"
            print(f"{name:22} {median:6.1f} ms, at most {greatest:6.1f} ms{mark}")


if __name__ == "__main__":
    main()

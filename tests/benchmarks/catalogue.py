"""`python -m tests.benchmarks.catalogue`: time to list 10,000 runs, sorted and filtered."""

import dataclasses
import statistics
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

from svsa.runs.metrics.metrics import Metrics
from svsa.runs.records.catalogue.database import Database
from svsa.runs.records.catalogue.entry import RunEntry
from svsa.runs.records.catalogue.runs import Catalogue
from svsa.runs.records.measured_window import MeasuredWindow
from svsa.runs.records.settings import RunSettings

RUNS = 10_000
PAGE = 20
REPEATS = 30
MARK_MS = 20.0
METRICS = Metrics(*(0.125,) * len(dataclasses.fields(Metrics)))
WINDOW = MeasuredWindow("load", "3 kg load", 5000, 20_000, 5.0, 20.0, False, ("NDOBC", "FL"))


def build_settings(number: int) -> RunSettings:
    """Build settings as varied as those of a class."""
    figure, stiffness = (("4a", 15.0), ("4b", 60.0), ("5", 35.0))[number % 3]
    law, load = ("ndobc", "fl")[number % 2], ("none", "paper", "mass")[number // 2 % 3]
    return RunSettings(
        name=f"Fig. {figure.upper()} · {law.upper()} · σ {stiffness:g} · {load}",
        figure=figure,
        figure_name=f"Fig. {figure.upper()}",
        motion="60° 0.2 Hz",
        laws=law.upper(),
        law_kinds=(law,),
        stiffness=f"{stiffness:g}",
        stiffness_nm_per_rad=stiffness,
        load=load,
        load_kinds=(load,),
        effects=("ideal", "rig", "full")[number % 7 % 3],
        own="",
    )


def fill(folder: Path) -> None:
    """Add 10,000 runs with names, tags, notes and metrics of two lanes to a catalogue."""
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
    )
    Database(folder / "catalogue.sqlite").add(
        *(
            dataclasses.replace(
                run,
                id=f"run-{number:05}",
                created=f"2026-01-{1 + number % 28:02}T{number % 24:02}:00:00+00:00",
                name=f"Group {number % 40} attempt {number}" if number % 2 else "",
                settings=build_settings(number),
                metrics=(dataclasses.replace(METRICS, peak_position_error_rad=number * 1e-6),) * 2,
                window=WINDOW,
                tags=("class", f"group-{number % 40}"),
            )
            for number in range(RUNS)
        )
    )


def measure(call: Callable[[], object]) -> tuple[float, float, float]:
    """Return median and maximum of the wall time of a call, and its median CPU time, ms."""
    walls, works = [], []
    for _ in range(REPEATS):
        begin, worked = time.perf_counter(), time.process_time()
        call()
        walls.append((time.perf_counter() - begin) * 1e3)
        works.append((time.process_time() - worked) * 1e3)
    return statistics.median(walls), max(walls), statistics.median(works)


def main() -> None:
    """Print the cost of each kind of list."""
    with tempfile.TemporaryDirectory() as folder:
        catalogue = Catalogue(folder)
        fill(Path(folder))
        pages = {
            "the first page": lambda: catalogue.list(page_size=PAGE),
            "the last page": lambda: catalogue.list(page_size=PAGE, page=RUNS // PAGE),
            "by name": lambda: catalogue.list(sort="name", page_size=PAGE),
            "by peak, greatest": lambda: catalogue.list(
                sort="-peak_position_error_rad", page_size=PAGE
            ),
            "by σ, a page in between": lambda: catalogue.list(
                sort="stiffness_nm_per_rad", page_size=PAGE, page=RUNS // PAGE // 2
            ),
            "of one law": lambda: catalogue.list(law="fl", page_size=PAGE),
            "law, load, figure, tag": lambda: catalogue.list(
                law="fl", load="paper", figure="4a", tag="group-7", page_size=PAGE
            ),
            "a search": lambda: catalogue.list("group attempt 99", page_size=PAGE),
            "a search for nothing": lambda: catalogue.list("no such words", page_size=PAGE),
            "a search with a law": lambda: catalogue.list("hand", law="fl", page_size=PAGE),
            "what to filter by": lambda: catalogue.list_facets(),
        }
        for name, call in pages.items():
            median, greatest, work = measure(call)
            mark = "" if work < MARK_MS else f"   more than {MARK_MS:g} ms"
            print(
                f"{name:24} {work:6.1f} ms of a processor;"
                f" {median:6.1f} ms, at most {greatest:6.1f} ms by the clock{mark}"
            )


if __name__ == "__main__":
    main()

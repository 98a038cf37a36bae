"""Monitoring: readiness, and metrics in the Prometheus format."""

import asyncio
import logging
import os
import shutil
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

from fastapi import FastAPI
from prometheus_client import CollectorRegistry, ProcessCollector
from prometheus_client.core import CounterMetricFamily, GaugeMetricFamily, Metric
from prometheus_client.exposition import choose_encoder
from prometheus_client.registry import Collector
from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import BaseRoute, Route

from svsa.hardware.session.session import BenchSession
from svsa.inputs.data_folder import find_data_folder
from svsa_server.access.guard import read_person
from svsa_server.access.permissions import OBSERVER, allow
from svsa_server.access.roles import Person
from svsa_server.sessions.bench_state import build_loop
from svsa_server.sessions.recording import NoCatalogue

POLL_S = 30.0
_GB = 1e9
_log = logging.getLogger("svsa")


class DiskWatch:
    """Free space of the data folder, which is reported before the disk is full.

    `problem` is a sentence while less than `low_bytes` are free, otherwise empty.
    """

    def __init__(self, folder: Path, low_bytes: float) -> None:
        self._folder, self._low = folder, low_bytes
        self.problem = ""

    async def run(self) -> None:
        """Measure every 30 s until cancelled."""
        while True:
            await asyncio.to_thread(self.check)
            await asyncio.sleep(POLL_S)

    def check(self) -> None:
        """Measure the free space; log a warning when it becomes low."""
        usage = self.measure()
        was_low, self.problem = bool(self.problem), ""
        if usage is not None and usage[0] < self._low:
            self.problem = (
                f"The disk is nearly full: {usage[0] / _GB:.1f} GB are free, less than"
                f" {self._low / _GB:g} GB. Delete studies, and the folders of deleted runs in"
                " SVSA_DATA/trash."
            )
            if not was_low:
                _log.warning("%s Folder: %s", self.problem, self._folder)

    def measure(self) -> tuple[int, int] | None:
        """Free and total bytes of the disk; None if the folder does not exist."""
        try:
            usage = shutil.disk_usage(self._folder)
        except OSError:
            return None
        return usage.free, usage.total


def list_problems(app: FastAPI) -> list[str]:
    """List why this lab is not ready for its users; empty if it is.

    A lab that is not ready still answers and controls: only some of its functions are unavailable.
    """
    state, problems = app.state, []
    if isinstance(state.catalogue, NoCatalogue) or not os.access(find_data_folder(), os.W_OK):
        problems.append("Nothing can be recorded: the data folder cannot be written.")
    if state.disk.problem:
        problems.append(state.disk.problem)
    for hosted in state.laboratory.sessions.values():
        session = hosted.session
        if isinstance(session, BenchSession) and not build_loop(session).alive:
            problems.append(f"The control loop of the bench is not running: {session.name}.")
    return problems


class LabCollector(Collector):
    """The metrics of a lab as one person may read them: sessions of others are not named."""

    def __init__(self, app: FastAPI, person: Person) -> None:
        self._state, self._person = app.state, person

    def collect(self) -> Iterator[Metric]:
        """All families; names and units by the conventions of Prometheus."""
        all_hosted = self._state.laboratory.sessions.values()
        sessions = [hosted.session for hosted in all_hosted]
        streams = sum(hosted.streams for hosted in all_hosted)
        by_kind = Counter((session.plant, session.status) for session in sessions)
        family = GaugeMetricFamily("svsa_sessions", "Open sessions", labels=["plant", "status"])
        for labels, number in by_kind.items():
            family.add_metric(labels, number)
        yield family
        yield GaugeMetricFamily("svsa_streams", "Open WebSocket streams of sessions", streams)
        recording = sum(session.journal.recorder is not None for session in sessions)
        yield GaugeMetricFamily("svsa_recordings", "Sessions that are being recorded", recording)
        family = GaugeMetricFamily(
            "svsa_session_delay_seconds",
            "Wall time by which the simulation of a session's run is late",
            labels=["session"],
        )
        for session in (each.session for each in all_hosted if self._person.may_see(each.owner)):
            if not isinstance(session, BenchSession):
                family.add_metric([session.name], session.pace.accumulated_delay_s)
        yield family
        family = GaugeMetricFamily("svsa_jobs", "Jobs that are kept", labels=["kind", "status"])
        jobs = Counter((job.kind, job.status) for job in self._state.jobs.list_all())
        for labels, number in jobs.items():
            family.add_metric(labels, number)
        yield family
        if (usage := self._state.disk.measure()) is not None:
            free, total = usage
            yield GaugeMetricFamily("svsa_disk_free_bytes", "Free space of the data folder", free)
            yield GaugeMetricFamily("svsa_disk_size_bytes", "Size of its disk", total)
        for session in sessions:
            if isinstance(session, BenchSession):
                yield from _collect_bench(session)


def _collect_bench(session: BenchSession) -> Iterator[Metric]:
    loop = build_loop(session)
    yield GaugeMetricFamily("svsa_bench_loop_alive", "1 while the bench's loop ticks", loop.alive)
    yield CounterMetricFamily("svsa_bench_ticks", "Ticks since the loop started", loop.ticks)
    yield CounterMetricFamily(
        "svsa_bench_skipped_ticks", "Ticks that were skipped", loop.skipped_ticks
    )
    family = GaugeMetricFamily(
        "svsa_bench_tick_lateness_seconds",
        "Lateness of the ticks since the loop started",
        labels=["quantile"],
    )
    for quantile, value in (
        ("0.5", loop.lateness_p50_s),
        ("0.99", loop.lateness_p99_s),
        ("0.999", loop.lateness_p999_s),
        ("1", loop.lateness_worst_s),
    ):
        family.add_metric([quantile], value)
    yield family


def build_metrics_route(app: FastAPI) -> BaseRoute:
    """`GET /metrics`: metrics of lab and process for Prometheus."""

    @allow(OBSERVER)
    async def serve_metrics(request: Request) -> Response:
        registry = CollectorRegistry()
        ProcessCollector(registry=registry)
        registry.register(LabCollector(app, read_person(request.scope)))
        encode, content_type = choose_encoder(request.headers.get("accept", ""))
        return Response(encode(registry), media_type=content_type)

    return Route("/metrics", serve_metrics)

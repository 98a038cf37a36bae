"""A small server with the routes of runs only, and three runs."""

import socket
import threading
from collections.abc import Iterator
from pathlib import Path

import httpx
import numpy as np
import pytest
import uvicorn
from fastapi import FastAPI

from svsa.actuators.signals import CHANNEL_INDEX
from svsa.runs.records.catalogue.runs import Catalogue
from svsa.runs.records.writer import write_record
from svsa_server.errors import install_error_handlers
from svsa_server.jobs.heavy_work import HeavyWork
from svsa_server.monitoring import DiskWatch
from svsa_server.routes import build_routes
from svsa_server.sessions.indexing import Indexing
from tests.runs.records.records import build_header, build_samples

FIRST_TICK = 1000
TICKS = 5000
POSITION = CHANNEL_INDEX["position_rad"]


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("data")


@pytest.fixture(scope="module")
def catalogue(data: Path) -> Catalogue:
    catalogue = Catalogue(data)
    for number in range(3):
        run_id = f"run-{number}"
        header = build_header(
            run_id,
            name=f"Run {number}",
            tags=(f"tag-{number}", "all"),
            created=f"2026-01-02T03:04:0{number}+00:00",
        )
        samples = build_samples(TICKS, first_tick=FIRST_TICK)
        samples[10, 0, POSITION] = np.nan
        samples[3333, 1, POSITION] = 1e6
        write_record(
            data / "runs" / run_id, header, [(1200, {"kind": "load"})], FIRST_TICK, samples
        )
        catalogue.register(header)
        catalogue.finish(run_id)
    return catalogue


@pytest.fixture(scope="module")
def app(catalogue: Catalogue) -> Iterator[FastAPI]:
    app = FastAPI()
    app.state.catalogue = catalogue
    app.state.indexing = Indexing(catalogue)
    app.state.disk = DiskWatch(catalogue.folder, 0.0)
    app.state.heavy_work = HeavyWork(most=10)
    install_error_handlers(app)
    app.router.routes.extend(build_routes())
    yield app
    app.state.heavy_work.close()


@pytest.fixture(scope="module")
def client(app: FastAPI) -> Iterator[httpx.Client]:
    server = uvicorn.Server(uvicorn.Config(app, log_level="warning", lifespan="off"))
    with socket.create_server(("127.0.0.1", 0)) as listener:
        thread = threading.Thread(target=server.run, kwargs={"sockets": [listener]}, daemon=True)
        thread.start()
        url = f"http://127.0.0.1:{listener.getsockname()[1]}"
        with httpx.Client(base_url=f"{url}/api/v1", timeout=300, trust_env=False) as client:
            yield client
        server.should_exit = True
        thread.join(10)

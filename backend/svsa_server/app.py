"""The application: routes, background tasks and guards put together."""

import asyncio
import contextlib
import logging
from collections.abc import AsyncIterator, Callable
from functools import partial
from typing import TYPE_CHECKING

from fastapi import FastAPI
from starlette.middleware.gzip import DEFAULT_EXCLUDED_CONTENT_TYPES, GZipMiddleware
from starlette.types import Scope

import svsa
from svsa.errors import ParameterError, Violation
from svsa.inputs.data_folder import find_data_folder
from svsa.inputs.extras import require_extra
from svsa.runs.definition.design_file import load_prototype, read_design
from svsa.runs.records.catalogue.runs import Catalogue
from svsa.runs.session.session import Session
from svsa.teaching.course.file import read_course
from svsa.teaching.course.progress import ProgressStore
from svsa_server.access.audit import AuditLog, Auditor
from svsa_server.access.authentication import (
    Authentication,
    ClassAuthentication,
    OpenAuthentication,
    SecretAuthentication,
)
from svsa_server.access.class_keys import ClassKeys
from svsa_server.access.guard import AccessGuard, find_path, read_person
from svsa_server.access.memberships import FILE, Memberships
from svsa_server.access.people import People
from svsa_server.access.permissions import PermissionTable
from svsa_server.access.rates import Rates
from svsa_server.access.roles import INSTRUCTOR
from svsa_server.config import Settings
from svsa_server.errors import ErrorAnswers, install_error_handlers
from svsa_server.jobs.heavy_work import HeavyWork
from svsa_server.jobs.queue import Jobs
from svsa_server.jobs.turns import Share
from svsa_server.leases.outcomes import OutcomeKeeper, Outcomes
from svsa_server.leases.queue import ControlQueue
from svsa_server.monitoring import DiskWatch, build_metrics_route
from svsa_server.openapi import install_openapi
from svsa_server.page import build_page_routes
from svsa_server.routes import build_routes
from svsa_server.scene.scenes import Scenes
from svsa_server.scene.viser_proxy import ViserProxy
from svsa_server.security_headers import SecuredApp
from svsa_server.sessions.bench_start import open_bench
from svsa_server.sessions.hosted import log_ended_lease
from svsa_server.sessions.indexing import Indexing
from svsa_server.sessions.laboratory import SHARED_SESSION, Laboratory, build_shared_session
from svsa_server.sessions.ownership import find_owner
from svsa_server.sessions.preparation import start_rehearsal
from svsa_server.sessions.quota import DiskQuota
from svsa_server.sessions.recording import Recordings, open_catalogue
from svsa_server.sessions.waiting import run_waiting

if TYPE_CHECKING:
    from svsa_server.lti.tool import LtiTool

_log = logging.getLogger("svsa")
JOBS = "jobs"
"""Folder of the jobs in the data folder."""
MAX_GRADINGS = 2
SMALLEST_COMPRESSED_BYTES = 1400
_COMPACT_TYPES = ("application/octet-stream", "application/vnd.apache.parquet")
_DESCRIPTION = (
    "Position and stiffness control of a serial variable stiffness actuator. SI units; every"
    " field ends in its unit. A rejected request changes nothing; the answer has name, value, unit"
    " and bound. If the lab has a shared secret, send it as a bearer token."
)


def build_app(
    config: Settings | None = None,
    shared: Session | None = None,
    keys: ClassKeys | None = None,
    host: str = "127.0.0.1",
    report: Callable[[str], None] = _log.info,
) -> FastAPI:
    """Build the lab as an ASGI application; sessions live as long as it runs.

    Args:
        config: Deployment settings.
        shared: The shared session; a simulated one by default.
        keys: Keys of a class, if they are already open.
        host: Address on which the server listens.
        report: Prints a line on the console.

    Returns:
        The application.
    """
    config = config or Settings()
    authentication = build_authentication(config, keys)
    app = SecuredApp(
        title="SVSA Lab",
        version=svsa.__version__,
        description=_DESCRIPTION,
        lifespan=_live,
        docs_url=None,
        redoc_url=None,
    )
    app.state.authentication = authentication
    app.state.config = config
    app.state.host = host
    app.state.report = report
    app.state.shared = shared
    app.state.design = read_design(config.parameters) if config.parameters else load_prototype()
    app.state.course = {exercise.name: exercise for exercise in read_course(config.course)}
    app.state.course_progress = ProgressStore(find_data_folder())
    app.state.lti = open_lti(config)
    app.state.outcomes = Outcomes()
    install_openapi(app, build_routes, needs_secret=authentication.kind != "open")
    app.state.viser = ViserProxy(lambda session: app.state.scenes.open(session))
    app.router.routes.extend((*build_routes(), *build_page_routes(), *app.state.viser.routes))
    app.router.routes.append(build_metrics_route(app))
    app.state.rates = build_rates(config) if config.classroom else None
    app.state.permissions = PermissionTable(app.router.routes)
    # The middleware added last sees a request first: the audit log also sees requests that the
    # guard rejects, and outcomes are stored for the user that the guard has identified.
    app.add_middleware(
        OutcomeKeeper,
        outcomes=app.state.outcomes,
        read_person_id=lambda scope: read_person(scope).id,
        has_route=partial(_has_route, app.state.permissions),
    )
    app.add_middleware(
        AccessGuard,
        authentication=authentication,
        permissions=app.state.permissions,
        hosts=config.host_names,
        find_owner=find_owner,
        rates=app.state.rates,
    )
    if config.classroom:
        app.state.audit = AuditLog(find_data_folder())
        app.add_middleware(Auditor, log=app.state.audit, permissions=app.state.permissions)
    app.add_middleware(ErrorAnswers)
    # Outermost, so that stored outcomes are plain. In a thread from 16 kB on, which would delay the
    # sessions by a millisecond.
    app.add_middleware(
        GZipMiddleware,
        minimum_size=SMALLEST_COMPRESSED_BYTES,
        compresslevel=5,
        thread_minimum_size=16 * 1024,
        exclude_content_types=(*DEFAULT_EXCLUDED_CONTENT_TYPES, *_COMPACT_TYPES),
    )
    install_error_handlers(app)
    return app


def _has_route(permissions: PermissionTable, scope: Scope) -> bool:
    return permissions.find(scope["method"], find_path(scope)).has_route


def build_authentication(config: Settings, keys: ClassKeys | None = None) -> Authentication:
    """Build the configured authentication."""
    if config.classroom:
        folder = find_data_folder()
        keys = keys or ClassKeys.open(folder)[0]
        return ClassAuthentication(keys, People(), Memberships(folder / FILE))
    return SecretAuthentication(config.secret_text) if config.secret_text else OpenAuthentication()


def open_lti(config: Settings) -> "LtiTool | None":
    """Open the LTI tool for launches of learning platforms, if it is configured.

    Raises:
        ParameterError: If the file is invalid, or the lab has no class.
    """
    if config.lti is None:
        return None
    if not config.classroom:
        raise ParameterError(Violation("SVSA_LTI", config.lti, "", "omitted without --class"))
    require_extra("lti")
    from svsa_server.lti.tool import LtiTool

    return LtiTool.open(config.lti, find_data_folder())


def build_rates(config: Settings) -> Rates:
    """Build the rate limits of a class."""
    return Rates(
        {
            "joins": config.joins,
            "codes": config.codes,
            "logins": config.logins,
            "commands": config.commands,
            "sessions": config.sessions,
            "runs": config.runs,
        }
    )


def build_queue(config: Settings) -> ControlQueue:
    """Build the control queue of a class's shared session."""
    return ControlQueue(
        SHARED_SESSION, lambda client: client == INSTRUCTOR.id, config.idle_operator_s
    )


@contextlib.asynccontextmanager
async def _live(app: FastAPI) -> AsyncIterator[None]:
    """Start the sessions; at the end stop them and their 3D views."""
    config: Settings = app.state.config
    shared = app.state.shared or build_shared_session(None, design=app.state.design)
    laboratory = Laboratory(
        shared,
        config.max_sessions,
        config.idle_s,
        config.control_s,
        build_queue(config) if config.classroom else None,
        config.max_sessions_each if config.classroom else None,
        *([partial(log_ended_lease, app.state.audit)] if config.classroom else []),
    )
    app.state.laboratory = laboratory
    app.state.catalogue = await asyncio.to_thread(open_catalogue)
    app.state.indexing = Indexing(app.state.catalogue, app.state.report)
    app.state.recordings = Recordings(app.state.catalogue)
    quota = DiskQuota(app.state.catalogue, laboratory, config.quota_mb * 1e6)
    app.state.quota = quota
    app.state.disk = DiskWatch(find_data_folder(), config.disk_low_gb * 1e9)
    app.state.heavy_work = HeavyWork(config.max_exports)
    app.state.jobs = await asyncio.to_thread(
        Jobs,
        {
            "tuning": config.max_tunings,
            "study": config.max_studies,
            "falsification": config.max_falsifications,
            "submission": config.max_submissions,
            "grading": MAX_GRADINGS,
        },
        Share(config.max_jobs_each, config.job_s) if config.classroom else None,
        find_data_folder() / JOBS,
    )
    app.state.scenes = scenes = Scenes(laboratory)
    tasks = [
        asyncio.create_task(laboratory.run()),
        asyncio.create_task(scenes.run()),
        asyncio.create_task(open_bench(shared)),
        asyncio.create_task(quota.run()),
        asyncio.create_task(app.state.disk.run()),
    ]
    if shared.plant == "simulated":
        start_rehearsal(shared.run.configuration)
    if app.state.lti is not None:
        from svsa_server.lti.scores import ScoreSender

        sender = ScoreSender(app.state.lti, app.state.course_progress, app.state.audit)
        tasks.append(asyncio.create_task(sender.run()))
    try:
        yield
    finally:
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)
        # Sessions before recordings: closing them ends the recordings, which are then finished.
        await run_waiting(laboratory.close)
        # In a thread, because they wait for a worker that is being started: while the event loop
        # does not run, the server takes its sessions for blocked, and ends with an error.
        app.state.jobs.drop()
        await asyncio.to_thread(app.state.heavy_work.close)
        await asyncio.to_thread(app.state.jobs.close)
        await app.state.recordings.close()
        await asyncio.to_thread(app.state.indexing.close)
        if isinstance(app.state.catalogue, Catalogue):
            app.state.catalogue.close()
        await app.state.viser.close()
        await scenes.close()
        if app.state.lti is not None:
            await app.state.lti.client.aclose()
        if config.classroom:
            app.state.audit.close()

"""The routes of the API: each module of these packages with a `router` is found and served."""

import pkgutil
from importlib import import_module

from fastapi import APIRouter
from starlette.routing import BaseRoute


def build_routes() -> list[BaseRoute]:
    """Return the routes below /api/v1 and /lti, the same ones for every application.

    Each module with a `router` at its top level is found automatically.
    """
    modules = pkgutil.walk_packages(__path__, f"{__name__}.")
    routers = (
        getattr(import_module(module.name), "router", None)
        for module in modules
        if not module.ispkg
    )
    return [route for router in routers if isinstance(router, APIRouter) for route in router.routes]

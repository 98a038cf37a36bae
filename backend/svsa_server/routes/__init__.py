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
        getattr(import_module(found.name), "router", None) for found in modules if not found.ispkg
    )
    return [route for one in routers if isinstance(one, APIRouter) for route in one.routes]

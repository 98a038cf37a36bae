"""The actuators that are installed, and their datasheets."""

import asyncio
import io
from functools import cache
from typing import Annotated, Literal

from fastapi import Depends, Path, Query, Response
from fastapi.responses import JSONResponse

from svsa.actuators.installed import get_mechanism
from svsa.actuators.mechanism import Mechanism
from svsa.analysis.datasheet.measure import Datasheet, measure_datasheet
from svsa.errors import ParameterError
from svsa.inputs.extras import require_extra
from svsa_server.access.permissions import OBSERVER, allow
from svsa_server.problems import UnknownError
from svsa_server.routes.depends import REFUSALS
from svsa_server.routing import build_router
from svsa_server.schemas.lab.actuator import (
    ActuatorState,
    DatasheetState,
    describe_actuator,
    describe_datasheet,
    list_actuators,
)

router = build_router("/actuators", tags=["lab"], responses=REFUSALS)


def _find(name: Annotated[str, Path(max_length=40, examples=["qbmove"])]) -> Mechanism:
    try:
        return get_mechanism(name)
    except ParameterError as error:
        raise UnknownError(str(error)) from None


NamedActuator = Annotated[Mechanism, Depends(_find)]


@router.get("")
@allow(OBSERVER)
async def read_actuators() -> list[ActuatorState]:
    """List the installed actuators, the SVSA first, with parameters, limits and sources."""
    return list_actuators()


@router.get("/{name}")
@allow(OBSERVER)
async def read_actuator(mechanism: NamedActuator) -> ActuatorState:
    """Read an installed actuator: parameters, limits and sources."""
    return describe_actuator(mechanism)


_measuring = asyncio.Lock()


@cache
def _measure(name: str) -> Datasheet:
    return measure_datasheet(name)


@router.get(
    "/{name}/datasheet",
    response_model=DatasheetState,
    responses={200: {"content": {"application/pdf": {}}}},
)
@allow(OBSERVER)
async def read_datasheet(
    mechanism: NamedActuator,
    format: Annotated[
        Literal["json", "pdf"], Query(description="JSON, or a page for printing")
    ] = "json",
) -> Response:
    """Measure the datasheet of an actuator (Grioli et al., IJRR 2015), once for all requests."""
    async with _measuring:
        datasheet = await asyncio.to_thread(_measure, mechanism.name)
    name = f"{mechanism.name}-datasheet.{format}"
    headers = {"Content-Disposition": f'inline; filename="{name}"'}
    if format == "pdf":
        require_extra("plot")
        page = await asyncio.to_thread(_draw, datasheet)
        return Response(page, media_type="application/pdf", headers=headers)
    return JSONResponse(describe_datasheet(datasheet).model_dump(mode="json"), headers=headers)


def _draw(datasheet: Datasheet) -> bytes:
    from svsa.analysis.datasheet.page import draw_page

    stream = io.BytesIO()
    draw_page(datasheet).savefig(stream, format="pdf")
    return stream.getvalue()

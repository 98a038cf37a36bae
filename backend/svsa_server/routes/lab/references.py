"""References before they are applied: read a CSV, preview a course."""

import asyncio
from typing import Annotated, Literal

import numpy as np
from fastapi import Body
from pydantic import BaseModel, Field

from svsa.inputs.checked import Checked, quantity
from svsa.simulation.reference.kinds import PositionReference, StiffnessReference, get_range
from svsa.simulation.reference.kinds.reference import AnyReference
from svsa.simulation.reference.kinds.series import MAX_ROWS, SeriesPosition, SeriesStiffness
from svsa.simulation.reference.preview import sample_reference
from svsa.simulation.reference.series_csv import parse_series
from svsa_server.access.permissions import OBSERVER, allow
from svsa_server.routes.depends import REFUSALS
from svsa_server.routing import build_router

router = build_router("/references", tags=["references"], responses={422: REFUSALS[422]})


class PositionSeries(BaseModel):
    """A CSV with angles, as `PUT …/position` takes it."""

    follows: Literal["position"] = "position"
    reference: SeriesPosition


class StiffnessSeries(BaseModel):
    """A CSV with stiffness, as `PUT …/stiffness` takes it."""

    follows: Literal["stiffness"] = "stiffness"
    reference: SeriesStiffness


Series = Annotated[PositionSeries | StiffnessSeries, Field(discriminator="follows")]


class PositionPreview(Checked):
    """A position reference, as PUT …/position takes it."""

    follows: Literal["position"] = quantity("", "Angles")
    reference: PositionReference = quantity("", "The reference")


class StiffnessPreview(Checked):
    """A stiffness reference, as PUT …/stiffness takes it."""

    follows: Literal["stiffness"] = quantity("", "Stiffness")
    reference: StiffnessReference = quantity("", "The reference")


PreviewRequest = Annotated[PositionPreview | StiffnessPreview, Field(discriminator="follows")]


class ReferencePreview(BaseModel):
    """Preview a reference, in SI units: its course, and its largest derivatives."""

    time_s: list[float]
    value: list[float] = Field(description="rad or N·m/rad")
    low: float = Field(description="Smallest value")
    high: float = Field(description="Largest value")
    peak_rate: float = Field(description="Largest |first derivative|, rad/s or N·m/rad/s")


@router.post("/csv")
@allow(OBSERVER)
async def read_csv(
    text: Annotated[
        str,
        Body(
            media_type="text/csv",
            description=f"time_s and position_rad, position_deg or stiffness_nm_per_rad; 2 to"
            f" {MAX_ROWS} rows below this header",
            examples=["time_s,position_deg\n0,0\n1,30\n2,0\n"],
        ),
    ],
) -> Series:
    """Read a time series from CSV text; an error names its row."""
    series = await asyncio.to_thread(parse_series, text)
    if isinstance(series, SeriesPosition):
        return PositionSeries(reference=series)
    return StiffnessSeries(reference=series)


@router.post("/preview")
@allow(OBSERVER)
async def preview_reference(
    wanted: Annotated[
        PreviewRequest,
        Body(
            examples=[
                {
                    "follows": "position",
                    "reference": {"kind": "minimum_jerk", "end_rad": 0.5, "duration_s": 1.0},
                },
                {
                    "follows": "stiffness",
                    "reference": {
                        "kind": "steps",
                        "time_s": [0.0, 2.0],
                        "stiffness_nm_per_rad": [15.0, 60.0],
                    },
                },
            ]
        ),
    ],
) -> ReferencePreview:
    """Compute the course of a reference of position or stiffness, before it is followed."""
    return await asyncio.to_thread(_preview, wanted.reference)


def _preview(reference: AnyReference) -> ReferencePreview:
    times, values = sample_reference(reference)
    low, high = get_range(reference)
    return ReferencePreview(
        time_s=times.tolist(),
        value=values[:, 0].tolist(),
        low=low,
        high=high,
        peak_rate=float(np.abs(values[:, 1]).max()),
    )

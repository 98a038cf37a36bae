"""Estimates with confidence intervals."""

from pydantic import BaseModel


class Estimate(BaseModel):
    """An estimate with the ends of its 95 % interval; null ends: the data support no interval."""

    value: float | None
    low: float | None
    high: float | None

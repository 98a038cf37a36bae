"""Which lane continues which one after the comparisons of a run have changed."""

from collections.abc import Sequence
from typing import Any

from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.design import Lane


def find_lane_origins(before: Configuration, after: Configuration) -> list[int | None]:
    """Return for each lane the number of the lane that it continues, from 0; None for a new one."""
    own, others = (
        list(zip(*_list_comparisons(configuration), strict=True))
        for configuration in (before, after)
    )
    width = len(after.joints)
    return [
        None if origin is None else width * origin + joint
        for origin in find_origins(own, others)
        for joint in range(width)
    ]


def _list_comparisons(configuration: Configuration) -> list[tuple[Lane, ...]]:
    return [joint.comparisons for joint in configuration.joints]


def find_origins(before: Sequence[Any], after: Sequence[Any]) -> list[int | None]:
    """Return for each plant the number of the plant that it continues, from 0; None for a new one.

    before, after: the comparisons, one for each plant after the first. Each joint of it is a lane.
    """
    left: list[Any] = [None, *before]
    origins: list[int | None] = [0]
    for comparison in after:
        origin = left.index(comparison) if comparison in left else None
        if origin is not None:
            left[origin] = None
        origins.append(origin)
    return origins

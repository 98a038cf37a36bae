"""What was set otherwise in one recorded run than in others."""

from dataclasses import asdict
from typing import Annotated

from fastapi import Query

from svsa.runs.records.difference import compare_settings
from svsa_server.access.owned import Owned
from svsa_server.routes.depends import REFUSALS, RunId, Runs
from svsa_server.routing import build_router
from svsa_server.schemas.runs.run import RunDifference, SettingDifference

MAX_OTHERS = 7
router = build_router(tags=["runs"], responses=REFUSALS)


@router.get("/runs/{run_id}/difference")
def read_difference(
    runs: Runs,
    run_id: RunId,
    other: Annotated[
        list[Annotated[str, Owned("run")]],
        Query(min_length=1, max_length=MAX_OTHERS, description="Ids of the runs beside it"),
    ],
) -> RunDifference:
    """What of the settings differs between a run and others, and nothing that does not."""
    ids = [run_id, *other]
    found = compare_settings([runs.open(one) for one in ids])
    return RunDifference(
        runs=ids,
        titles=[runs.get(one).title for one in ids],
        differences=[SettingDifference(**asdict(one)) for one in found],
    )

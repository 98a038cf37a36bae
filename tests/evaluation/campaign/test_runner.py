"""Parts of a campaign are run once each, and those that wait at the end are not begun."""

import pytest

from svsa.evaluation.campaign.runner import AHEAD, run_parts


@pytest.mark.parametrize("workers", [0, 1])
def test_part_is_requested_when_a_worker_is_free_and_none_after_the_end(workers):
    requested = []
    whole = range(-99, 0)
    assert list(run_parts(workers, abs, whole)) == [(part, -part) for part in whole]
    parts = run_parts(workers, abs, (requested.append(part) or part for part in whole))
    assert next(parts) == (-99, 99)
    parts.close()
    assert len(requested) == (AHEAD * workers or 1)
    with pytest.raises(TypeError):
        list(run_parts(workers, abs, ["no number"]))

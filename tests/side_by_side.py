"""Which process takes which module next under `pytest -n … --dist loadfile`.

Tests in a browser wait for pages where the others compute, and a process that has begun with
browsers has an event loop that others cannot bear. So a few processes go over to browsers while the
rest is still at the others, that no core waits at the end; a browser and a lab of its own cost a
process more to start than some modules to do.
"""

import math
from functools import cached_property
from pathlib import PurePosixPath

from xdist.scheduler import LoadFileScheduling
from xdist.workermanage import WorkerController

BROWSER = "tests/browser/"
LONGEST = (
    *("test_schema_fuzz", "test_identification", "test_attacks", "test_stream", "test_cluster"),
    *("test_can_plant_faults", "test_closed_loop", "test_private_sessions", "test_class"),
    *("test_replay_page", "test_bench_check", "test_stability_command", "test_run_anew"),
    *("test_bench_plants", "test_bench_faults", "test_schema_auth", "test_exercises"),
    *("test_leaderboard", "test_extras", "test_execution", "test_compilation"),
    *("test_studies", "test_design", "test_script", "test_life", "test_view"),
    *("test_falsifier", "test_layout", "test_bench", "test_control", "test_accessibility"),
    *("test_plots", "test_replay", "test_lti", "test_safety", "test_grades", "test_memory"),
    "test_compiled_calls",
)
"""They begin, so that no process is left with one of them while the others are done."""


WORTH = 20
"""So many modules of the browser's there must be for each process that goes over to them."""

OTHERS_EACH = 6
"""So many others are done by the rest in the time that one module of the browser's takes."""


def rank(unit: str) -> int:
    """The place of a module, by its path."""
    name = PurePosixPath(unit).stem
    return LONGEST.index(name) if name in LONGEST else len(LONGEST)


class SideBySide(LoadFileScheduling):
    """Whole modules, the longest first, each to a process that is at its kind."""

    def _assign_work_unit(self, node: WorkerController) -> None:
        unit = self.choose(node)
        if unit is None:
            node.shutdown()
        else:
            self.workqueue.move_to_end(unit, last=False)
            super()._assign_work_unit(node)

    def choose(self, node: WorkerController) -> str | None:
        """None: what is left cannot be in a process whose browser keeps an event loop running."""
        units = sorted(self.workqueue, key=rank)
        browser = [unit for unit in units if unit.startswith(BROWSER)]
        others = [unit for unit in units if not unit.startswith(BROWSER)]
        if any(unit.startswith(BROWSER) for unit in self.assigned_work[node]):
            kinds = (browser,)
        elif self.is_to_show(node) and len(others) <= OTHERS_EACH * len(browser):
            kinds = (browser, others)
        else:
            kinds = (others, browser)
        return next((kind[0] for kind in kinds if kind), None)

    def is_to_show(self, node: WorkerController) -> bool:
        """One process for every `WORTH` modules, and at most one half of them."""
        number = int(node.gateway.id.removeprefix("gw"))
        return number % 2 == 1 and number // 2 < math.ceil(self.browser_modules / WORTH)

    @cached_property
    def browser_modules(self) -> int:
        """How many there are, from the first to the last."""
        assert self.collection is not None
        modules = {self._split_scope(test) for test in self.collection}
        return sum(module.startswith(BROWSER) for module in modules)

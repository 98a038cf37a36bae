"""Which process takes which module next under `pytest -n … --dist loadfile`.

Tests in a browser wait for pages where the others compute. One half of the processes begins with
the one kind and one half with the other, so that no core waits for long, and only one half has a
browser and a lab of its own before it comes to help the other, where that is worth another.
"""

from pathlib import PurePosixPath

from xdist.scheduler import LoadFileScheduling
from xdist.workermanage import WorkerController

BROWSER = "tests/browser/"
LONGEST = (
    *("test_schema_fuzz", "test_identification", "test_can_plant_faults", "test_closed_loop"),
    *("test_replay_page", "test_cluster", "test_bench_check", "test_stability_command"),
    *("test_bench_plants", "test_bench_faults", "test_schema_doors", "test_exercises"),
    *("test_leaderboard", "test_extras", "test_execution", "test_compilation"),
    *("test_studies", "test_design", "test_class", "test_script", "test_life", "test_view"),
    *("test_falsifier", "test_layout", "test_bench", "test_control", "test_accessibility"),
    *("test_plots", "test_replay", "test_lti", "test_safety", "test_grades", "test_memory"),
)
"""They begin, so that no process is left with one of them while the others are done."""


WORTH = 8
"""So many modules must be left: a browser and a lab cost more to start than some of them to do."""


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
        elif int(node.gateway.id.removeprefix("gw")) % 2:
            kinds = (browser, others)
        elif len(self.nodes) > 1 and len(browser) < WORTH:
            kinds = (others,)
        else:
            kinds = (others, browser)
        return next((kind[0] for kind in kinds if kind), None)

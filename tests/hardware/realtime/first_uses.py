"""First uses on a bench's loop in virtual time, in a process that has loaded nothing before.

    python -m tests.hardware.realtime.first_uses ready|run

It prints, as JSON, what each message to the loop and the tick after it have loaded.
"""

import json
import math
import sys
from collections.abc import Iterator
from types import SimpleNamespace
from typing import Any

from numba.core import event

from svsa.control.gains import Gains
from svsa.control.installed import get_law, list_law_names
from svsa.control.parameters import LawParameters
from svsa.errors import ParameterError
from svsa.hardware.bench.homing import STEPS
from svsa.hardware.realtime.configuration import build_bench_configuration, read_actuation
from svsa.hardware.realtime.loop import BenchLoop
from svsa.hardware.realtime.memory import LoopMemory, SampleArray
from svsa.hardware.realtime.prepared_laws import PreparedLaws, compute_constants
from svsa.hardware.realtime.process import LoopProcess
from svsa.hardware.realtime.warm_up import list_changes, warm_up
from svsa.runs.definition.paper import get_figure
from tests.hardware.wired_bench import WiredBench

ARMING_TICKS, RAMP_TICKS = 1500, 500
EMULATOR_S = 0.1
"""In which the emulator, in this process, has loaded its own code."""


class LoadCounter(event.Listener):
    """Counts how often numba acquired its lock: to compile, or to load compiled code."""

    loads = 0

    def on_start(self, event: event.Event) -> None:
        self.loads += 1

    def on_end(self, event: event.Event) -> None:
        pass


class Rehearsal:
    """A warmed-up loop, and its answers."""

    def __init__(self, wired: WiredBench, memory: LoopMemory) -> None:
        self.wired, self.laws, bench = wired, PreparedLaws(), wired.bench
        wanted = get_figure("4a").build_configuration(load=False)
        self.loop = BenchLoop(
            wired.plant,
            read_actuation(bench),
            bench.home.lever_ratio,
            build_bench_configuration(bench, wanted),
            SampleArray(1),
            self.laws.bind,
        )
        wired.skip(EMULATOR_S)
        warm_up(self.loop, self.laws, lambda step: None)
        wired.plant.catch_up()
        absent: Any = SimpleNamespace(beat=lambda slot: None)
        self.process = LoopProcess(
            self.loop, wired.plant, wired.clock, 1.0, absent, memory, absent, self.laws
        )
        self.counter = LoadCounter()
        event.register("numba:compiler_lock", self.counter)

    def give(self, do: str, argument: Any = None, ticks: int = 1) -> dict[str, Any]:
        """Send a command; return the answer, and the code loaded in it and in the next ticks.

        Computations of the server for this command are not counted.
        """
        loads, modules = 0, list[str]()
        for _ in range(10):
            before, known = self.counter.loads, set(sys.modules)
            answer = self.ask(do, argument)
            self.wired.drive(self.loop, ticks)
            loads += self.counter.loads - before
            modules += sorted(set(sys.modules) - known)
            if "unprepared" not in answer:
                break
            computed = json.loads(json.dumps(compute_constants(answer["unprepared"])))
            before = self.counter.loads
            assert self.ask("prepare", computed) == {}
            loads += self.counter.loads - before
        return {"loads": loads, "modules": modules, "refused": answer.get("refused")}

    def ask(self, do: str, argument: Any) -> dict[str, Any]:
        message = {"number": 1, "do": do, "argument": argument, "until": math.inf}
        return json.loads(json.dumps(self.process._answer(message)))

    def change(self, kind: str, argument: Any) -> dict[str, Any]:
        return self.give("change", {"tick": 0, "kind": kind, "argument": argument})


def vary(parameters: LawParameters) -> Iterator[LawParameters]:
    """Vary the parameters: each number in turn slightly or much larger or smaller."""
    for name, value in parameters:
        for factor in (1.01, 0.99, 2.0, 0.5):
            try:
                if isinstance(value, tuple):
                    yield parameters.changed(**{name: tuple(factor * one for one in value)})
                elif isinstance(value, float):
                    yield parameters.changed(**{name: factor * value})
            except ParameterError:
                continue


def list_other_parameters() -> dict[str, list[LawParameters]]:
    """For every law with its own parameters."""
    laws = [get_law(name) for name in list_law_names()]
    return {law.name: [*vary(law.parameters())] for law in laws if law.parameters is not Gains}


def main(state: str) -> None:
    found: list[tuple[str, dict[str, Any]]] = []
    memory = LoopMemory.create()
    with WiredBench() as wired:
        rehearsal = Rehearsal(wired, memory)
        configuration = rehearsal.loop.run.configuration
        found.append(("arm", rehearsal.give("arm", ticks=ARMING_TICKS)))
        found += [
            (step.name, rehearsal.give("home", {"step": step.name, "by": "a test"}))
            for step in STEPS
        ]
        if state == "run":
            found.append(("start", rehearsal.give("start")))
        else:
            loaded = configuration.changed(law="fl").model_dump(mode="json")
            found.append(("load", rehearsal.give("load", loaded)))
        found += [(law, rehearsal.change("law", law)) for law in list_law_names()]
        for law, others in list_other_parameters().items():
            parameters = {law: others[0].model_dump(mode="json")} if others else {law: {}}
            found.append((f"parameters {law}", rehearsal.change("parameters", parameters)))
            found.append((f"law {law}", rehearsal.change("law", law)))
        found += [
            (f"{kind} {argument}", rehearsal.change(kind, argument))
            for kind, argument in list_changes(configuration, list(list_law_names()))
        ]
        status = wired.plant.status
        found.append(("stop", rehearsal.give("stop", "a test", RAMP_TICKS)))
        found.append(("quick_stop", rehearsal.give("quick_stop", "a test")))
        found.append(("clear", rehearsal.give("clear")))
    memory.close()
    sys.stdout.write(json.dumps({"status": status, "found": found}))


if __name__ == "__main__":
    main(sys.argv[1])

"""No command to a bench with a running loop imports, compiles or loads code in a tick."""

import json
import subprocess
import sys
from collections.abc import Iterator
from importlib.metadata import EntryPoint
from typing import Any, NamedTuple

import numpy as np
import pytest

from svsa.actuators.signals import Torque
from svsa.control import installed
from svsa.control.installed import list_law_names
from svsa.control.law import Law
from svsa.control.parameters import LawParameters
from svsa.errors import StateError
from svsa.hardware.realtime import prepared_laws
from svsa.hardware.realtime.launch import _check
from svsa.hardware.realtime.memory import LoopMemory
from svsa.hardware.realtime.prepared_laws import compute_constants
from svsa.hardware.realtime.warm_up import list_changes
from svsa.hardware.session.supervised_loop import SupervisedLoop
from svsa.numerics.compilation import compiled
from svsa.runs.definition.command import COMMANDS, OF_ARM
from svsa.runs.definition.design import Lane
from svsa.runs.definition.paper import get_figure
from svsa.runs.execution.blocks import bind_law, build_blocks
from svsa.simulation.plant.loads import LOADS
from svsa.simulation.plant.loads.load import TIP
from svsa.simulation.reference.kinds import POSITIONS, STIFFNESSES
from tests.exhaustive import exhaust
from tests.hardware.realtime.first_uses import Rehearsal, list_other_parameters
from tests.hardware.wired_bench import WiredBench

FIGURE = get_figure("4a").build_configuration(load=False)
OWN_PARAMETERS = list_other_parameters()


@pytest.mark.parametrize("state", exhaust(["ready", "run"], ["run"]))
def test_first_uses_load_nothing_in_a_tick(state: str) -> None:
    """Every law, also with other parameters, and every kind of command, in a new process."""
    program = [sys.executable, "-m", "tests.hardware.realtime.first_uses", state]
    reported = json.loads(subprocess.run(program, check=True, stdout=subprocess.PIPE).stdout)
    assert reported["status"] == state
    names = {name for name, _ in reported["found"]}
    assert names >= {*list_law_names(), *(f"parameters {law}" for law in OWN_PARAMETERS)}
    nothing = {"loads": 0, "modules": [], "refused": None}
    assert {name: found for name, found in reported["found"] if found != nothing} == {}


def test_warm_up_has_every_kind_of_command_reference_and_load() -> None:
    changes = list_changes(FIGURE, list(list_law_names()))
    assert {kind for kind, _ in changes} == set(COMMANDS) - set(OF_ARM)
    loads = [load for load in LOADS if load.acts_as != TIP]
    for kind, found in (("position", POSITIONS), ("stiffness", STIFFNESSES), ("load", loads)):
        kinds = {one.model_fields["kind"].default for one in found}
        assert {argument["kind"] for of, argument in changes if of == kind} == kinds


class Rows(LawParameters):
    """The number of constants."""

    rows: int = 2


class Table(NamedTuple):
    """As many numbers as the parameters state."""

    table: tuple[float, ...]


@compiled
def rest(nominal, constants, memory, x, reference, estimate, applied, period):
    return Torque(0.0, 0.0)


def fail_to_build(parameters, setting):
    raise ZeroDivisionError("no gain")


def build_table(parameters, setting):
    return Table((1.0,) * parameters.rows)


FAILING = Law("failing", "Failing", "", "", "", rest, build=fail_to_build)
VARIABLE = Law("variable", "Variable", "", "", "", rest, parameters=Rows, build=build_table)


@pytest.fixture(scope="module")
def rehearsal() -> Iterator[Rehearsal]:
    """A warmed-up loop, with broken laws of other packages."""
    others = {"failing": f"{__name__}:FAILING", "variable": f"{__name__}:VARIABLE"}
    others["missing"] = "no_such_package_of_laws:LAW"
    memory, entries = LoopMemory.create(), installed._find_entries()
    for name, value in others.items():
        entries[name] = EntryPoint(name, value, installed.GROUP)
    with WiredBench() as wired:
        yield Rehearsal(wired, memory)
    for name in others:
        del entries[name]
    installed._load_law.cache_clear()
    memory.close()


@pytest.mark.parametrize(
    ("law", "reason"), [("failing", "no gain"), ("missing", "No module named 'no_such_package")]
)
def test_broken_law_is_rejected_with_its_reason(
    rehearsal: Rehearsal, law: str, reason: str
) -> None:
    before = rehearsal.loop.run.configuration
    for kind, argument in (("law", law), ("comparisons", [{"law": law}])):
        found = rehearsal.change(kind, argument)
        assert f"The law {law} is not ready on this bench" in found["refused"]
        assert reason in found["refused"] and "Restart the loop" in found["refused"]
        assert (found["loads"], found["modules"]) == (0, [])
    assert rehearsal.loop.run.configuration == before
    assert rehearsal.change("law", "pid")["refused"] is None, "the others are not affected"


def test_constants_of_another_layout_are_rejected(rehearsal: Rehearsal) -> None:
    """Compiling the law for them would stop the loop."""
    assert rehearsal.change("law", "variable")["refused"] is None
    before = rehearsal.loop.run.configuration
    found = rehearsal.ask("change", write("parameters", {"variable": {"rows": 3}}))
    computed = json.loads(json.dumps(compute_constants(found["unprepared"])))
    answer = rehearsal.ask("prepare", computed)
    assert "variable is not compiled for constants of this layout" in answer["refused"]
    assert rehearsal.loop.run.configuration == before
    assert rehearsal.change("law", "ndobc")["refused"] is None


def write(kind: str, argument: Any) -> dict[str, Any]:
    return {"tick": 0, "kind": kind, "argument": argument}


@pytest.mark.parametrize("law", OWN_PARAMETERS)
def test_parameters_of_a_law_do_not_change_the_layout_of_its_constants(law: str) -> None:
    layouts = set()
    for parameters in [installed.get_law(law).parameters(), *OWN_PARAMETERS[law]]:
        configuration = FIGURE.changed(law=law, parameters={law: parameters})
        blocks = build_blocks(configuration, Lane(law=law), 0.5)
        key = law, parameters.model_dump_json(), prepared_laws.build_setting(blocks)
        wanted = {**dict(zip(prepared_laws._KEY, key, strict=True)), "mechanism": "svsa"}
        wanted = json.loads(json.dumps(wanted))
        layouts.add(compute_constants(wanted)["layout"])
    assert len(layouts) == 1


@pytest.mark.parametrize("law", OWN_PARAMETERS)
def test_constants_of_the_server_equal_those_of_the_loop_bit_for_bit(
    rehearsal: Rehearsal, law: str
) -> None:
    rehearsal.loop.load(rehearsal.loop.run.configuration)
    assert rehearsal.change("law", law)["refused"] is None
    for parameters in OWN_PARAMETERS[law][:2]:
        given = {law: parameters.model_dump(mode="json")}
        assert rehearsal.change("parameters", given)["refused"] is None
        run = rehearsal.loop.run
        wanted = bind_law(run.configuration, run.configuration.lanes[0], run.blocks[0])
        assert run.configuration.parameters[law] == parameters
        assert run.laws[0].function == wanted.function
        for name in ("nominal", "constants"):
            found, expected = getattr(run.laws[0], name), getattr(wanted, name)
            np.testing.assert_array_equal(found.view(np.uint64), expected.view(np.uint64))


def test_law_that_returns_before_the_next_tick_starts_without_memory(
    rehearsal: Rehearsal,
) -> None:
    """Prepared laws are the same object, but the memory is a new one."""
    loop = rehearsal.loop
    loop.load(loop.run.configuration)
    assert rehearsal.change("law", "fl_integral")["refused"] is None
    loop.warm_up()
    _, law, memory = loop._connected
    for name in ("ndobc", "fl_integral"):
        assert rehearsal.ask("change", write("law", name)).keys() == {"tick"}
    assert loop.run.laws[0] is law
    assert loop.run.lanes[0].memory is not memory
    loop.warm_up()
    assert loop._connected[2] is loop.run.lanes[0].memory


def test_only_the_most_recent_laws_are_kept(
    rehearsal: Rehearsal, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(prepared_laws, "MAX_BOUND", len(rehearsal.laws._bound))
    rehearsal.change("law", "pid")
    for parameters in OWN_PARAMETERS["pid"]:
        given = {"pid": parameters.model_dump(mode="json")}
        assert rehearsal.change("parameters", given)["refused"] is None
    assert len(rehearsal.laws._bound) == prepared_laws.MAX_BOUND


def test_server_computes_missing_constants_and_repeats_the_request() -> None:
    """At most once for each lane; a later rejection of the loop is the answer."""

    class Processes:
        def __init__(self, lacking: int) -> None:
            self.asked, self._lacking = list[str](), lacking

        def request(self, wanted: str, argument: Any = None) -> dict[str, Any]:
            self.asked.append(wanted)
            if wanted == "change" and self._lacking:
                self._lacking -= 1
                _check({"refused": "no", "unprepared": {"law": "pid"}})
            return {"tick": 7}

    def ask(lacking: int) -> tuple[list[str], dict[str, Any]]:
        loop: Any = SupervisedLoop.__new__(SupervisedLoop)
        loop.starting, loop.processes = False, Processes(lacking)
        return loop.processes.asked, loop.ask("change", {})

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(
            "svsa.hardware.session.supervised_loop.compute_constants", lambda wanted: wanted
        )
        asked, answer = ask(2)
        assert (asked, answer) == (["change", "prepare"] * 2 + ["change"], {"tick": 7})
        with pytest.raises(StateError):
            ask(100)

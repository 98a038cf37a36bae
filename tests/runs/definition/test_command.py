"""A command is one frozen value: serialized, applied to a run, derived from a configuration."""

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

import svsa
from svsa.runs.definition.command import (
    COMMANDS,
    RemoveLoad,
    Set,
    build_command,
    fold,
    read_command,
)
from svsa.runs.execution.run import Run
from svsa.runs.timeline.loads import follow_loads, list_loads
from tests.runs.session.scripts import ARGUMENTS, loads, scripted
from tests.runs.session.sessions import build_configuration

LANES = (svsa.Lane(law="fl"),)
KINDS = sorted({*ARGUMENTS} - {"load", "unload"})
given_kinds = st.sampled_from(KINDS).flatmap(lambda kind: st.tuples(st.just(kind), ARGUMENTS[kind]))


@scripted
@given(given_kinds)
def test_command_changes_the_configuration(drawn):
    run = Run(build_configuration(comparisons=LANES))
    before = run.configuration
    try:
        command = build_command(0, *drawn)
        run.change(command)
    except svsa.ParameterError:
        assert run.configuration == before
        return
    assert fold(before, command) == run.configuration


@scripted
@given(
    st.sampled_from(sorted(ARGUMENTS)).flatmap(
        lambda kind: st.tuples(st.just(kind), ARGUMENTS[kind])
    )
)
def test_command_is_read_as_written(drawn):
    command = build_command(7, *drawn)
    written = json.loads(json.dumps(command.to_json()))
    assert list(written) == ["tick", "kind", "argument"]
    assert read_command(written) == command
    assert read_command(written | {"of_a_later_version": 1}) == command


def test_command_is_immutable_and_has_a_readable_form():
    command = Set("law", "fl", tick=3)
    with pytest.raises(ValueError, match="frozen"):
        command.tick = 4
    assert command.changed(tick=4) == Set("law", "fl", tick=4)
    labels = [*COMMANDS.values()]
    assert all(labels) and len({*labels}) == len(labels)


@pytest.mark.parametrize(
    ("make", "name"),
    [
        (lambda: Set("law", "fl", tick=-1), "tick"),
        (lambda: Set("laws", (), tick=0), "laws"),
        (lambda: build_command(0, "laws", ()), "laws"),
        (lambda: build_command(0, "unload", 1.5), "unload"),
        (lambda: build_command(0, "load", {"kind": "push", "torque_nm": (0, 0, 0), "hold_s": -1}),
         "hold_s"),
        (lambda: build_command(0, "dance", None), "kind"),
        (lambda: read_command({"tick": None, "kind": "law", "argument": "fl"}), "tick"),
    ],
)  # fmt: skip
def test_error_of_a_command_names_its_field(make, name):
    with pytest.raises(svsa.ParameterError) as refused:
        make()
    assert [violation.name for violation in refused.value.violations] == [name]


def test_every_former_change_is_a_command():
    fields = set(svsa.Change.model_fields) - {"at_s", "joint"}
    assert fields <= set(COMMANDS)


@scripted
@given(st.lists(loads, min_size=1, max_size=5), st.integers(1, 5), st.integers(1, 400))
def test_loads_of_a_run_are_those_of_its_commands(given_loads, number, taken_at):
    """Two readers, the run itself and a reader of its commands, apply one rule."""
    commands = [
        build_command(40 * position, "load", load) for position, load in enumerate(given_loads)
    ]
    commands.append(RemoveLoad(tick=200 + taken_at, argument=number))
    run, taken = Run(build_configuration()), None
    for command in commands:
        run.tick = command.tick
        try:
            taken = run.change(command)
        except svsa.StateError:
            return
    reported = {load.number: load for load in list_loads(run.configuration, commands)}
    assert taken is not None
    assert reported[number] == taken._replace(end_tick=min(taken.end_tick, commands[-1].tick))
    for load in run.loads:
        assert reported[load.number] == load


def test_load_removed_twice_ends_the_first_time():
    (load,) = follow_loads([svsa.PaperLoad()], [(5, 1), (9, 1)], 0.001)
    assert (load.start_tick, load.end_tick) == (0, 5)

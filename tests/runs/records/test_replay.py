"""Exact replay: configuration, seed and commands reproduce every bit of a session."""

import hashlib
import json
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given

import svsa
from svsa.control.installed import list_law_names
from svsa.runs.definition.command import Set, read_command
from svsa.runs.definition.configuration import Configuration
from svsa.runs.execution.replay import replay, simulate_again
from tests.runs.session.scripts import (
    collect,
    play,
    play_busy_session,
    read,
    scripted,
    scripts,
    seeds,
    wake_sizes,
    write,
)
from tests.runs.session.sessions import (
    EVERY_EFFECT,
    PULSE,
    build_configuration,
    build_session,
    read_samples,
)


@scripted
@given(scripts, wake_sizes, seeds)
def test_script_of_commands_reproduces_the_samples(script, wakes, seed):
    """Through JSON and back; every lane for its lifetime, also after a fault."""
    session = build_session(PULSE, seed=seed)
    play(session, script, wakes)
    configuration, commands = read(write(session))
    assert configuration == session.journal.initial
    assert commands == session.journal.commands
    turns = [command.tick for command in commands if command.kind == "comparisons"]
    ticks, first = session.run.tick, max(turns, default=0)
    if first < ticks:
        found = collect(configuration, commands, first, ticks - first)
        for number, lane in enumerate(found):
            np.testing.assert_array_equal(lane, read_samples(session, number)[first:])
    pieces = [samples[0] for _, samples in replay(configuration, commands, ticks)]
    if pieces:
        np.testing.assert_array_equal(np.vstack(pieces), read_samples(session))


def test_new_process_reproduces_the_bits():
    """Neither the memory nor the compiled code of this process is needed."""
    session = play_busy_session()
    first, ticks = session.journal.commands[-1].tick, session.run.tick
    program = (
        "import hashlib, json, sys\n"
        "import numpy as np\n"
        "from svsa.runs.definition.command import read_command\n"
        "from svsa.runs.execution.replay import simulate_again\n"
        "from svsa.runs.definition.configuration import Configuration\n"
        "written = json.load(sys.stdin)\n"
        "commands = [read_command(command) for command in written['commands']]\n"
        "configuration = Configuration(**written['configuration'])\n"
        f"stretches = simulate_again(configuration, commands, {first}, {ticks - first})\n"
        "samples = np.concatenate(list(stretches), axis=1)\n"
        "print(samples.shape, hashlib.sha256(samples.tobytes()).hexdigest())\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", program],
        input=write(session),
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    own = np.stack([read_samples(session, lane)[first:] for lane in (0, 1)])
    assert done.stdout.strip() == f"{own.shape} {hashlib.sha256(own.tobytes()).hexdigest()}"


def test_other_seed_gives_another_run():
    """A record must contain the seed."""
    session = play_busy_session()
    other = collect(session.journal.initial.changed(seed=4), session.journal.commands[:-1], 0, 100)[
        0
    ]
    assert np.any(other != read_samples(session)[:100])


def test_part_of_a_record_is_simulated_from_the_start():
    session = play_busy_session()
    whole = read_samples(session)
    first = next(
        command.tick for command in session.journal.commands if command.kind == "comparisons"
    )
    for start, ticks in ((0, 1), (0, first), (29, 3), (57, first - 57)):
        found = collect(session.journal.initial, session.journal.commands, start, ticks)
        np.testing.assert_array_equal(found[0], whole[start : start + ticks])


def test_record_without_a_sample_is_valid():
    """A session that was changed and never ran, or a run that ended at its first tick."""
    commands = [Set("law", "fl", tick=0)]
    assert list(simulate_again(build_configuration(), commands, 0, 0)) == []
    assert list(simulate_again(build_configuration(), commands, 7, 0)) == []


@pytest.mark.parametrize("argument", ["json", "python"])
def test_configuration_is_unchanged_by_json(argument):
    """Every field, including loads and lanes."""
    lane = svsa.Lane(law="fl", gains=svsa.Gains.from_poles([-50.0] * 4, [-30.0] * 2))
    configuration = build_configuration(
        PULSE, svsa.MassLoad(), comparisons=(lane,), effects=EVERY_EFFECT, seed=2**63 - 1
    )
    written = configuration.model_dump(mode=argument)
    if argument == "json":
        written = json.loads(json.dumps(written, allow_nan=False))
    assert Configuration(**written) == configuration


PAPER = {"kind": "paper"}
LAWS = ", ".join(list_law_names())
GARBAGE = {
    "nothing": ({}, "is missing"),
    "no kind": ({"tick": 3, "argument": "fl"}, "kind"),
    "an unknown kind": ({"tick": 3, "kind": "explode", "argument": 1}, "kind"),
    "a kind that is a list": ({"tick": 3, "kind": ["load"], "argument": PAPER}, "kind"),
    "no tick": ({"kind": "load", "argument": PAPER}, "tick"),
    "a negative tick": ({"tick": -1, "kind": "load", "argument": PAPER}, "tick"),
    "a broken tick": ({"tick": 1.5, "kind": "load", "argument": PAPER}, "tick"),
    "a tick that is a truth": ({"tick": True, "kind": "load", "argument": PAPER}, "tick"),
    "no argument": ({"tick": 3, "kind": "load"}, "load"),
    "an unknown load": ({"tick": 3, "kind": "load", "argument": {"kind": "wind"}}, "kind"),
    "a field too much": (
        {"tick": 3, "kind": "load", "argument": PAPER | {"x": 1}},
        "x: unknown field",
    ),
    "no name of a law": ({"tick": 3, "kind": "law", "argument": "P I D"}, f"here: {LAWS}."),
    "a number as a text": ({"tick": 3, "kind": "unload", "argument": "1"}, "an integer"),
    "a list": ([], "command"),
    "null": (None, "command"),
}


@pytest.mark.parametrize("what", GARBAGE)
def test_invalid_command_is_rejected_clearly(what):
    """As any invalid value: its name, the expected value, in one line."""
    written, words = GARBAGE[what]
    with pytest.raises(svsa.ParameterError) as refused:
        read_command(written)
    assert words in str(refused.value)
    assert "\n" not in str(refused.value)
    assert "pydantic" not in str(refused.value)

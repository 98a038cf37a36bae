"""The description of a recorded run's settings matches its samples."""

from typing import Any

import pytest

from svsa.actuators.installed import get_mechanism
from svsa.actuators.signals import CHANNELS
from svsa.runs.definition.command import build_command
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.design import Lane, LaneSetting
from svsa.runs.definition.design_file import load_prototype
from svsa.runs.definition.experiment import build_actuator_experiment
from svsa.runs.definition.paper import get_figure
from svsa.runs.records.header import RecordHeader
from svsa.runs.records.settings import RunSettings, describe_settings
from svsa.simulation.plant.effects import RIG
from svsa.simulation.plant.effects.friction import Friction
from svsa.simulation.plant.loads.mass import MassLoad
from svsa.simulation.plant.loads.paper import PaperLoad
from svsa.simulation.plant.loads.pulse import PulseLoad
from svsa.simulation.plant.loads.push import PushLoad
from svsa.simulation.reference.kinds.constant import ConstantPosition, ConstantStiffness

TICKS = 8000


def build_header(configuration: Configuration, **changes: Any) -> RecordHeader:
    values = {
        "version": "0.1.0",
        "run_id": "run-1",
        "created": "2026-01-02T03:04:05+00:00",
        "session": "lab",
        "lanes": tuple(f"lane{number + 1}" for number in range(len(configuration.lanes))),
        "configuration": configuration.model_dump(mode="json"),
        "seed": 0,
        "period_s": 0.001,
        "channels": CHANNELS,
    }
    return RecordHeader(**(values | changes))


def describe(
    *commands: tuple[int, str, Any],
    figure: str = "4a",
    first_tick: int = 0,
    ticks: int = TICKS,
    header: dict[str, Any] | None = None,
    **changes: Any,
) -> RunSettings:
    configuration = get_figure(figure).build_configuration(load=False).changed(**changes)
    written = [(tick, build_command(tick, kind, value).to_json()) for tick, kind, value in commands]
    return describe_settings(
        build_header(configuration, **(header or {})), written, first_tick, ticks
    )


def sigma(value: float) -> ConstantStiffness:
    return ConstantStiffness(stiffness_nm_per_rad=value)


def test_figure_with_its_load_has_its_common_name() -> None:
    loads = (PaperLoad(start_s=5.0),)
    settings = describe(figure="4b", loads=loads, comparisons=(Lane(law="fl"),))
    assert settings.name == "Fig. 4B · NDOBC vs FL · σ 60 · 3 kg"
    assert (settings.figure, settings.law_kinds, settings.load_kinds) == (
        "4b",
        ("ndobc", "fl"),
        ("paper",),
    )
    assert settings.stiffness_nm_per_rad == 60.0
    assert (settings.effects, settings.own) == ("ideal", "")


@pytest.mark.parametrize(
    "changes",
    [
        {"loads": ()},
        {"loads": (PaperLoad(start_s=37.0),)},
        {"loads": (MassLoad(start_s=5.0),)},
        {"loads": (PaperLoad(start_s=5.0), MassLoad(start_s=6.0))},
        {"effects": RIG},
        {"nominal": load_prototype().actuator},
    ],
)
def test_run_with_other_settings_is_not_named_as_the_figure(
    changes: dict[str, Any],
) -> None:
    changes = {"loads": (PaperLoad(start_s=5.0),)} | changes
    settings = describe(ticks=60_000, **changes)
    assert (settings.figure, settings.figure_name) == ("4a", "Fig. 4A motion")


def test_manual_load_at_the_time_of_the_figure_names_the_figure() -> None:
    """The load counts by its time in the run, whether it was planned or not."""
    by_hand = (5000, "load", PaperLoad())
    assert describe(by_hand).figure_name == "Fig. 4A"
    assert describe(by_hand, (6000, "unload", 1)).figure_name == "Fig. 4A motion"
    mass = (5000, "load", MassLoad())
    assert describe(mass, header={"plant": "emulated"}).figure_name == "Fig. 6A"


def test_load_after_the_record_is_not_named() -> None:
    loads = (PaperLoad(start_s=5.0),)
    assert describe(loads=loads, ticks=5000).load == "no load"
    assert describe(loads=loads, ticks=5001).load == "3 kg"
    assert describe(loads=loads, ticks=5000).load_kinds == ("none",)


def test_load_removed_before_the_record_is_not_named() -> None:
    hung = ((100, "load", PaperLoad()), (900, "unload", 1))
    assert describe(*hung, first_tick=900, ticks=100).load == "no load"
    assert describe(*hung, first_tick=899, ticks=100).load == "3 kg"
    pulse = PulseLoad(torque_nm=(5.0, 0.0, 0.0), duration_s=0.2)
    assert describe((0, "load", pulse), first_tick=200).load == "no load"
    assert describe((0, "load", pulse), first_tick=199).load == "pulse 5 N·m"


def test_different_loads_are_named_and_repeated_ones_counted() -> None:
    again = ((0, "load", PaperLoad()), (100, "unload", 1), (200, "load", PaperLoad()))
    assert describe(*again).load == "3 kg (2×)"
    mass = MassLoad(mass_kg=1.5, arm_m=0.1)
    assert describe((0, "load", PaperLoad()), (5, "load", mass)).load == (
        "3 kg + 1.5 kg mass at 100 mm"
    )


def test_continued_manual_load_is_one_load() -> None:
    """Held from 1 s to 1.3 s; a second one is another load."""
    reported = [
        (tick, "load", PushLoad(torque_nm=(tick / 1000, 0.0, 0.0), hold_s=0.2))
        for tick in (1000, 1100, 1200)
    ]
    assert describe(*reported, (1300, "unload", 1)).load == "push"
    assert describe(*reported, (1300, "unload", 1), first_tick=1300, ticks=50).load == "no load"
    assert describe(*reported, (2000, "load", reported[0][2])).load == "push (2×)"


def test_change_during_the_record_is_shown_with_an_arrow() -> None:
    settings = describe((3000, "law", "fl"), (4000, "stiffness", sigma(60)))
    assert settings.name == "From Fig. 4A · NDOBC → FL · σ 15 → 60 · no load"
    assert settings.law_kinds == ("ndobc", "fl")
    assert (settings.figure, settings.figure_name) == ("4a", "from Fig. 4A")


def test_changes_outside_the_record_are_ignored() -> None:
    changes = (
        (1000, "law", "fl"),
        (1000, "stiffness", sigma(60)),
        (9000, "law", "ndobc"),
    )
    settings = describe(*changes, first_tick=1000, ticks=8000)
    assert settings.name == "Fig. 4B motion · FL · σ 60 · no load"
    assert settings.law_kinds == ("fl",)


def test_first_and_last_of_many_steps_are_named() -> None:
    steps = [(tick, "stiffness", sigma(15 + tick / 100)) for tick in (100, 200, 300, 400)]
    assert describe(*steps).stiffness == "15 → … → 19"
    assert describe((100, "stiffness", sigma(15))).stiffness == "15"


def test_custom_motion_is_no_figure() -> None:
    settings = describe(position=ConstantPosition(position_rad=0.5235987755982988))
    assert settings.figure == ""
    assert settings.name == "Held at 30° · NDOBC · σ 15 · no load"


def test_fade_in_does_not_change_the_figure() -> None:
    slowly = ConstantStiffness(stiffness_nm_per_rad=15, transition_s=3)
    assert describe(stiffness=slowly).figure == "4a"


def test_effects_and_own_design_are_reported() -> None:
    assert describe(effects=RIG).name == "Fig. 4A motion · NDOBC · σ 15 · no load · rig"
    rough = RIG.changed(friction=Friction())
    assert describe(effects=rough).effects == "encoders, estimated velocities, friction, delay 1"
    exact = load_prototype().actuator
    assert describe(nominal=exact).own == "model"
    assert describe(nominal=exact).name.endswith(" · own model")


def describe_actuator(name: str, **changes: Any) -> RunSettings:
    configuration = build_actuator_experiment(name, "ndobc", load=False).changed(**changes)
    return describe_settings(build_header(configuration), [], 0, TICKS)


def test_run_of_another_actuator_is_named_after_it() -> None:
    settings = describe_actuator("qbmove")
    assert settings.own == ""
    assert settings.name.startswith("qbmove · ")
    assert settings.name.endswith(" · NDOBC · σ 1.73 · no load")
    exact = get_mechanism("qbmove").prototype
    assert describe_actuator("qbmove", nominal=exact).own == "model"
    assert describe_actuator("awas2").name.startswith("AwAS-II · ")


def test_another_actuator_in_the_motion_and_load_of_a_figure_is_not_the_figure() -> None:
    figure = get_figure("4a").build_configuration()
    changes = {"position": figure.position, "stiffness": figure.stiffness, "loads": figure.loads}
    found = describe_actuator("awas2", **changes)
    assert found.figure_name == "Fig. 4A motion"


def test_actuator_that_is_not_installed_names_its_run() -> None:
    written = build_actuator_experiment("qbmove", "ndobc").model_dump(mode="json")
    written["actuator"]["mechanism"] = "cubic"
    header = build_header(get_figure("4a").build_configuration())
    header = header.changed(configuration=written)
    assert describe_settings(header, [], 0, TICKS).name.startswith("cubic · ")


def test_bench_is_named_with_its_twin_and_its_own_figures() -> None:
    header = {"plant": "emulated"}
    settings = describe(header=header, comparisons=(Lane(law="ndobc"),))
    assert settings.name == "Fig. 6A motion · NDOBC vs twin · σ 15 · no load · emulated bench"


@pytest.mark.parametrize(
    "configuration",
    [{}, {"law": "ndobc", "loads": []}, {"law": "of tomorrow", "loads": [{"kind": "new"}]}],
)
def test_unreadable_settings_are_omitted(configuration: dict) -> None:
    header = build_header(get_figure("4a").build_configuration(load=False))
    odd = header.changed(configuration=configuration)
    commands = [(5, {"kind": "stiffness", "argument": {"kind": "of tomorrow"}}), (6, {})]
    settings = describe_settings(odd, commands, 0, 10)
    assert settings.figure == settings.motion == ""
    assert settings.stiffness == ""


def test_unreadable_change_is_a_question_mark() -> None:
    header = build_header(get_figure("4a").build_configuration(load=False))
    unread = [(5, {"kind": "stiffness", "argument": {"kind": "of tomorrow"}})]
    settings = describe_settings(header, unread, 0, 10)
    assert (settings.stiffness, settings.figure_name) == ("15 → ?", "from Fig. 4A")


def test_exchanged_laws_are_reported_for_every_lane() -> None:
    settings = describe((3000, "laws", ("fl", "ndobc")), comparisons=(Lane(law="fl"),))
    assert settings.name.split(" · ")[1] == "NDOBC → FL vs FL → NDOBC"
    assert settings.law_kinds == ("ndobc", "fl")


def test_reconfigured_lane_is_reported_as_a_comparison() -> None:
    setting = LaneSetting(lane=2, setting=Lane(law="fl_integral"))
    assert (
        describe((3000, "lane", setting), comparisons=(Lane(law="fl"),)).laws
        == "NDOBC vs FL → FL + I"
    )

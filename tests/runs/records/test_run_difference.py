"""The differences between the settings of runs are listed completely, without other entries."""

from typing import Any

from svsa.runs.definition.command import build_command
from svsa.runs.definition.design import Lane
from svsa.runs.definition.paper import get_figure
from svsa.runs.records.difference import compare_settings, format_poles
from svsa.runs.records.reader import Record, build_record
from svsa.runs.session.simulated import SimulatedSession
from svsa.simulation.plant.effects import IDEAL, RIG
from svsa.simulation.plant.effects.noise import SensorNoise
from svsa.simulation.plant.loads.paper import PaperLoad
from svsa.simulation.reference.kinds.constant import ConstantPosition, ConstantStiffness

from .records import build_samples
from .test_run_settings import build_header


def record(
    *commands: tuple[int, str, Any], figure: str = "4a", ticks: int = 50, **changes: Any
) -> Record:
    """A record of this many ticks from the first on, with the commands of a real session."""
    configuration = get_figure(figure).build_configuration(load=False).changed(**changes)
    session = SimulatedSession("lab", configuration)
    for tick, kind, argument in commands:
        session.step(tick - session.run.tick)
        session.change(build_command(0, kind, argument))
    written = [(command.tick, command.to_json()) for command in session.journal.commands]
    header = build_header(configuration)
    return build_record(header, written, 0, build_samples(ticks, len(header.lanes)))


def compare(*records: Record) -> dict[tuple[str, str, str], tuple]:
    return {(one.group, one.name, one.unit): one.values for one in compare_settings(records)}


def test_runs_with_equal_settings_do_not_differ() -> None:
    assert compare(record(), record()) == {}
    back = ((0, "law", "fl"), (0, "law", "ndobc"))
    assert compare(record(), record(*back)) == {}


def test_number_is_reported_with_its_unit_and_law_by_its_name() -> None:
    assert compare(record(), record(figure="4b", law="fl")) == {
        ("Stiffness", "Stiffness reference", "N·m/rad"): (15.0, 60.0),
        ("Controller", "Law", ""): ("NDOBC", "FL"),
    }


def test_three_runs_are_compared_at_once() -> None:
    stiff = ConstantStiffness(stiffness_nm_per_rad=40)
    assert compare(record(), record(), record((0, "stiffness", stiff))) == {
        ("Stiffness", "Stiffness reference", "N·m/rad"): (15.0, 15.0, 40.0)
    }


def test_other_kind_of_motion_has_other_values() -> None:
    still = ConstantPosition(position_rad=0.5)
    assert compare(record(), record(position=still)) == {
        ("Motion", "Form", ""): ("sine", "constant"),
        ("Motion", "Mean", "rad"): (0.0, None),
        ("Motion", "Amplitude", "rad"): (1.0471975511965976, None),
        ("Motion", "Frequency f", "Hz"): (0.2, None),
        ("Motion", "Phase", "rad"): (0.0, None),
        ("Motion", "Position reference", "rad"): (None, 0.5),
    }


def test_effect_is_on_or_off_with_its_values_and_noise_seed() -> None:
    noisy = record(effects=IDEAL.changed(noise=SensorNoise()))
    assert compare(record(), noisy) == {
        ("Realism", "Sensor noise", ""): ("off", "on"),
        ("Realism", "Standard deviation, motors", "rad"): (None, 2e-5),
        ("Realism", "Standard deviation, deflection", "rad"): (None, 2e-4),
        ("Realism", "Seed of the noise", ""): (None, "0"),
    }


def test_gains_are_reported_as_poles_and_lanes_by_their_laws() -> None:
    gains = record().header.configuration["gains"]
    faster = dict(gains, stiffness_coefficients=(2500.0, 100.0))
    one, other = record(gains=faster), record(comparisons=(Lane(law="fl"),))
    assert compare(one, other) == {
        ("Controller", "Stiffness poles, rad/s", ""): ("−50 (2×)", "−40 (2×)"),
        ("Controller", "Comparison lanes", ""): ("nothing", "FL"),
    }


def test_loads_and_changes_are_reported_with_their_times() -> None:
    loaded = record((10, "load", PaperLoad()), (20, "law", "fl"))
    assert compare(record(), loaded) == {
        ("Loads", "Loads", ""): ("no load", "3 kg after 0.01 s"),
        ("Changed while it was recorded", "Law", ""): (None, "FL after 0.02 s"),
    }
    unreached = record((10, "load", PaperLoad(start_s=1.0)))
    assert compare(record(), unreached) == {}


def test_same_value_of_plant_and_model_is_distinguished() -> None:
    names = compare(record(), record((0, "effects", RIG), (0, "nominal", record_actuator())))
    groups = {group for group, _, _ in names}
    assert groups == {"Realism", "Model of the controller"}


def record_actuator() -> dict[str, Any]:
    return record().header.configuration["actuator"]


def test_poles_are_reported_to_three_digits() -> None:
    assert format_poles([-59.991, -60 - 0.0086j, -60 + 0.0086j, -60.0086]) == "−60 (4×)"
    assert format_poles([-24.41 - 24.4j, -24.41 + 24.4j]) == "−24.4 ± 24.4j"

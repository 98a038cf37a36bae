"""Records with former names of fields and commands are read and replayed."""

from pathlib import Path

import pytest

from svsa.control.installed import get_law, read_parameters
from svsa.hardware.session.replay import verify_bench_record
from svsa.runs.records.former_words import FIELDS, KINDS, MOTION, translate_path, translate_results
from svsa.runs.records.reader import open_record
from svsa.runs.records.resimulation import compare_with_simulation, read_origin
from svsa.runs.result.recorded import open_run

RECORDS = Path(__file__).parents[2] / "data" / "records"


@pytest.mark.parametrize(("name", "file"), [("simulated", "header.json"), ("bench", "header.json")])
def test_records_contain_the_former_names(name: str, file: str) -> None:
    """Otherwise the other tests would check nothing."""
    text = (RECORDS / name / file).read_text(encoding="utf-8")
    assert all(f'"{former}"' in text for former in FIELDS)


@pytest.mark.parametrize("name", ["simulated", "comparisons", "arm"])
def test_former_record_is_replayed_bit_for_bit(name: str) -> None:
    record = open_record(RECORDS / name)
    compared = compare_with_simulation(record)
    assert compared.identical, compared.first_difference
    assert compared.ticks == record.tick_count > 0


def test_former_arm_has_joint_2_among_its_joints() -> None:
    header = (RECORDS / "arm" / "header.json").read_text(encoding="utf-8")
    assert '"joint2"' in header and '"length2_m"' in header
    configuration, _ = read_origin(open_record(RECORDS / "arm"))
    assert [joint.stiffness.stiffness_nm_per_rad for joint in configuration.joints] == [80.0, 60.0]
    assert [link.length_m for link in configuration.require_arm().links.chain] == [0.3, 0.25]


@pytest.mark.parametrize(
    ("former", "present"),
    [
        ("arm.joint2.stiffness", "arm.other_joints[0].stiffness"),
        ("arm.links.mass2_kg", "arm.links.chain[1].mass_kg"),
        ("arm.model.inertia1_kg_m2", "arm.model.chain[0].inertia_kg_m2"),
        ("actuator.link_inertia_kg_m2", "actuator.link_inertia_kg_m2"),
    ],
)
def test_former_path_is_the_present_one(former: str, present: str) -> None:
    assert translate_path(former) == present


def test_former_command_has_its_present_kind() -> None:
    commands = (RECORDS / "comparisons" / "commands.jsonl").read_text(encoding="utf-8")
    assert '"kind": "rivals"' in commands
    _, (first, _) = read_origin(open_record(RECORDS / "comparisons"))
    assert first.kind == KINDS["rivals"]
    assert [lane.law for lane in first.argument] == ["fl"]


@pytest.mark.exhaustive
@pytest.mark.long
def test_former_bench_record_follows_from_its_measurements() -> None:
    start = (RECORDS / "bench" / "bench-start.json").read_text(encoding="utf-8")
    assert all(f'"{former}"' in start for former in MOTION)
    record = open_record(RECORDS / "bench")
    verified = verify_bench_record(record)
    assert (verified.ticks, verified.missed) == (record.tick_count, 0)


def test_former_record_is_opened_as_a_result() -> None:
    result = open_run(RECORDS / "simulated")
    lanes = (result, *result.comparisons)
    assert [one.law for one in lanes] == ["ndobc", "fl", "ndobc_s"]


def test_former_names_of_parameters_are_read() -> None:
    model = get_law("ndobc_s").parameters
    present = {name: 1.01 * getattr(model(), name) for name in model.former_names.values()}
    former = {was: present[name] for was, name in model.former_names.items()}
    assert len(former) == len(present) == 9
    assert read_parameters("ndobc_s", former) == model(**present) != model()


def test_former_leaderboard_entry_has_the_present_names() -> None:
    written = {
        "standing": {"draws": 100, "draws_held": 93, "worst": {"scenario": "unloading_12_3"}}
    }
    worst = {"scenario": "load_removal_12_3"}
    present = {"standing": {"trials": 100, "trials_held": 93, "worst": worst}}
    assert translate_results(written) == present
    assert translate_results(present) == present

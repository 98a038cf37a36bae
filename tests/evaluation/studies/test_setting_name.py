"""The name of a setting is that of its declared field, with the unit of its number."""

import pytest

from svsa.errors import ParameterError
from svsa.evaluation.studies.file import list_built_in, read_study
from svsa.evaluation.studies.setting_name import name_setting, name_variation
from tests.evaluation.studies.studies import build_study

TWO_LOADS = {
    "figure": "4a",
    "loads": [
        {"kind": "constant", "torque_nm": [1, 0, 0]},
        {"kind": "pulse", "torque_nm": [1, 0, 0], "start_s": 1, "duration_s": 0.1},
    ],
}


@pytest.mark.parametrize(
    ("path", "words", "unit"),
    [
        ("actuator.link_inertia_kg_m2", "Output link inertia M", "kg·m²"),
        ("nominal.link_inertia_kg_m2", "Nominal: Output link inertia M", "kg·m²"),
        ("actuator.spiral_reduction", "Reduction γ of the spiral", ""),
        ("effects.friction.coulomb1_nm", "Coulomb, motor 1", "N·m"),
        ("effects", "Effects", ""),
        ("gains.position_bandwidth_rad_per_s", "Bandwidth of the position error", "rad/s"),
        ("observer.bandwidth_rad_per_s", "Observer bandwidth β", "rad/s"),
        ("observer.bandwidth_rad_per_s[1]", "Observer bandwidth β of motor 1", "rad/s"),
        ("loads[1].torque_nm[0]", "2: Load on the link", "N·m"),
        ("loads[1].duration_s", "2: Duration", "s"),
    ],
)
def test_setting_has_the_name_and_unit_of_its_field(path, words, unit):
    base = build_study(base=TWO_LOADS, vary=()).build_base("ndobc")
    assert name_setting(base, path) == (words, unit)


def test_settings_of_the_packaged_studies_have_names():
    for name in list_built_in():
        study = read_study(name)[1]
        base = study.build_base(study.laws[0])
        reported = [name_variation(base, one) for one in study.vary]
        assert len({one.words for one in reported}) == len(reported)
        for variation, one in zip(study.vary, reported, strict=True):
            assert variation.path.split(".")[-1] not in one.words
            assert one.words.endswith(", factor") == variation.relative
            assert not (variation.relative and one.unit)


def test_unknown_setting_has_no_name():
    with pytest.raises(ParameterError, match="one of link_inertia"):
        name_setting(build_study().build_base("ndobc"), "actuator.mass")

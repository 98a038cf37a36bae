"""Parameter files: written values are read back, and an invalid file is reported."""

import tomllib

import pytest
import tomli_w

import svsa

GOOD = """
[actuator]
link_inertia_kg_m2 = 0.0103
motor1_inertia_kg_m2 = 0.0234
motor2_inertia_kg_m2 = 0.014
link_damping_nms_per_rad = 0.005
motor1_damping_nms_per_rad = 0.005
motor2_damping_nms_per_rad = 0.001
spring_stiffness_n_per_m = { value = 1882, source = "a spring scale" }
radius_m = 0.075
spiral_reduction = 1
reaction_torque = "energy"
"""


@pytest.fixture
def written(tmp_path):
    path = tmp_path / "design.toml"
    svsa.write_design(path, svsa.load_prototype(), "a test")
    return path


def test_written_design_is_read_back_unchanged(written):
    assert svsa.read_design(written) == svsa.load_prototype()


def test_every_written_value_has_its_source(written):
    sections = tomllib.loads(written.read_text(encoding="utf-8"))
    entries = [entry for section in sections.values() for entry in section.values()]
    assert len(entries) > 20
    assert all(entry["source"] == "a test" for entry in entries)


def test_every_value_of_the_prototype_has_a_source():
    """Table 1, the text of the paper, or declared as assumed."""
    from importlib.resources import files

    text = (files("svsa.actuators") / "prototype.toml").read_text(encoding="utf-8")
    for section in tomllib.loads(text).values():
        for name, entry in section.items():
            assert set(entry) == {"value", "source"}, name
            assert entry["source"], name


def test_prototype_is_table_1():
    """The numbers of the paper: plant and nominal model."""
    design = svsa.load_prototype()
    true, nominal = design.actuator, design.nominal
    assert true.rotational_stiffness_nm_per_rad == pytest.approx(10.58625, rel=1e-12)
    names = ("link_inertia_kg_m2", "motor1_inertia_kg_m2", "motor2_inertia_kg_m2")
    assert [getattr(true, name) for name in names] == [0.0103, 0.0234, 0.014]
    assert [getattr(nominal, name) for name in names] == [0.0153, 0.0284, 0.019]
    names = ("link_damping_nms_per_rad", "motor1_damping_nms_per_rad", "motor2_damping_nms_per_rad")
    assert [getattr(true, name) for name in names] == [0.005, 0.005, 0.001]
    assert [getattr(nominal, name) for name in names] == [0.007, 0.007, 0.003]
    assert true.reaction_torque == nominal.reaction_torque == "energy"


def test_value_may_have_a_source(written):
    text = written.read_text(encoding="utf-8")
    rest = text[text.index("[nominal") :]
    written.write_text(GOOD + rest, encoding="utf-8")
    assert svsa.read_design(written) == svsa.load_prototype()


INTEGRAL = """
[parameters.fl_integral]
position_pole_rad_per_s = { value = 40.0, source = "tuned by hand" }
stiffness_pole_rad_per_s = 25
"""


def test_law_has_its_own_table(written):
    """With or without sources; written values are read back, and control a run."""
    written.write_text(written.read_text(encoding="utf-8") + INTEGRAL, encoding="utf-8")
    design = svsa.read_design(written)
    (parameters,) = design.parameters.values()
    poles = {"position_pole_rad_per_s": 40.0, "stiffness_pole_rad_per_s": 25.0}
    assert parameters.model_dump() == poles
    svsa.write_design(written, design, "again")
    assert svsa.read_design(written) == design
    table = tomllib.loads(written.read_text(encoding="utf-8"))["parameters"]["fl_integral"]
    assert table["position_pole_rad_per_s"] == {"value": 40.0, "source": "again"}
    run = svsa.simulate("4a", "fl_integral", parameters=written, duration_s=0.01)
    assert run.configuration.parameters["fl_integral"] == parameters


def test_file_without_a_law_leaves_the_parameters_of_laws_unchanged(written):
    own = {"fl_integral": {"position_pole_rad_per_s": 40.0}}
    configuration = svsa.paper.get_figure("4a").build_configuration().changed(parameters=own)
    run = svsa.simulate(configuration, parameters=written, duration_s=0.01)
    assert run.configuration.parameters == configuration.parameters


BROKEN_LAWS = {
    "a value beyond its bound": (
        INTEGRAL.replace("40.0", "400.0"),
        "parameters.fl_integral.position_pole_rad_per_s is 400.0 rad/s: it must be at most 150",
    ),
    "a misspelt name": (
        INTEGRAL.replace("position_pole", "position_poles"),
        "parameters.fl_integral.position_poles_rad_per_s",
    ),
    "a law that is not installed": (
        INTEGRAL.replace("fl_integral", "fl_integrall"),
        "parameters is 'fl_integrall': it must be a law that is installed here: ndobc",
    ),
    "a law that takes gains": (
        INTEGRAL.replace("fl_integral", "ndobc"),
        "omitted: ndobc takes the run's gains",
    ),
    "no table": ("[parameters]\nfl_integral = 3\n", "parameters.fl_integral is 3"),
}


@pytest.mark.parametrize("kind", BROKEN_LAWS)
def test_invalid_table_of_a_law_is_rejected_with_file_and_name(written, kind):
    text, words = BROKEN_LAWS[kind]
    written.write_text(written.read_text(encoding="utf-8") + text, encoding="utf-8")
    with pytest.raises(svsa.ParameterError) as refused:
        svsa.read_design(written)
    assert str(refused.value).startswith(f"{written}: ")
    assert words in str(refused.value)


BROKEN = {
    "no TOML": ("[actuator\n", "readable TOML"),
    "an empty file": ("", "actuator is missing"),
    "a value below its bound": (GOOD.replace("0.0103", "-1.0"), "link_inertia_kg_m2 is -1.0 kg"),
    "a text for a number": (GOOD.replace("0.0103", '"heavy"'), "link_inertia_kg_m2 is 'heavy'"),
    "NaN": (GOOD.replace("0.0103", "nan"), "link_inertia_kg_m2 is nan"),
    "a number that is too large": (GOOD.replace("0.0103", "1e400"), "link_inertia_kg_m2"),
    "a misspelt name": (GOOD.replace("radius_m", "radius"), "radius_m is missing"),
    "an unknown law": (GOOD.replace('"energy"', '"guess"'), "reaction_torque is 'guess'"),
    "an unknown section": (GOOD + "[weather]\nwind = 1\n", "weather"),
    "a number for a section": ("actuator = 3\n", "actuator"),
    "a list of sections": ("[[actuator]]\nradius_m = 1.0\n", "actuator"),
    "a section with the name of a Python word": (GOOD + "[self]\na = 1\n", "self"),
}


@pytest.mark.parametrize("kind", BROKEN)
def test_invalid_file_is_rejected_with_reason(tmp_path, kind):
    text, words = BROKEN[kind]
    path = tmp_path / "broken.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(svsa.ParameterError) as refused:
        svsa.read_design(path)
    assert words in str(refused.value)


def test_missing_or_binary_file_is_rejected(tmp_path):
    binary = tmp_path / "binary.toml"
    binary.write_bytes(b"\xff\xfe\x00\x01")
    for path in (tmp_path / "absent.toml", tmp_path, binary):
        with pytest.raises(svsa.ParameterError, match="parameter file"):
            svsa.read_design(path)


def test_all_invalid_values_are_named_at_once(tmp_path):
    """A student corrects a file once, not once for each mistake."""
    path = tmp_path / "broken.toml"
    wrong = GOOD.replace("0.0103", "-1.0").replace("0.0234", '"x"')
    path.write_text(wrong, encoding="utf-8")
    with pytest.raises(svsa.ParameterError) as refused:
        svsa.read_design(path)
    names = {violation.name for violation in refused.value.violations}
    assert names >= {
        "actuator.link_inertia_kg_m2",
        "actuator.motor1_inertia_kg_m2",
        "nominal",
        "gains",
    }
    assert refused.value.violations[0].unit == "kg·m²"


@pytest.mark.parametrize("section", ["actuator", "nominal"])
def test_fields_of_one_name_are_distinguished_by_their_section(tmp_path, section):
    """Plant and model have the same fields: only the path identifies the invalid one."""
    design = svsa.load_prototype()
    path = tmp_path / "design.toml"
    svsa.write_design(path, design, "a test")
    sections = tomllib.loads(path.read_text(encoding="utf-8"))
    sections[section]["radius_m"] = 0.0
    path.write_text(tomli_w.dumps(sections), encoding="utf-8")
    with pytest.raises(svsa.ParameterError) as refused:
        svsa.read_design(path)
    (violation,) = refused.value.violations
    assert violation.name == f"{section}.radius_m"
    assert violation.message == f"{section}.radius_m is 0.0 m: it must be at least 0.001 m."
    assert violation.limits == {"ge": 0.001}

"""Every actuator: known answers, derivatives, energy balance, passivity, a member's contract."""

import math
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import svsa
from svsa.actuators.dynamics import (
    ExternalLoad,
    build_actuator,
    compute_acceleration,
    compute_internal_torque,
)
from svsa.actuators.elasticity import (
    compute_coordinate,
    compute_coordinate_for_stiffness,
    compute_derivatives,
    compute_stiffness_of,
)
from svsa.actuators.energy import compile_energy, write_source
from svsa.actuators.installed import get_mechanism, list_mechanism_names
from svsa.actuators.linearization import compute_linearization
from svsa.actuators.mechanism import (
    MAX_ELASTIC,
    PAPERS_DAMPING_NMS_PER_RAD,
    PAPERS_INERTIA,
    Mechanism,
    perturb,
)
from svsa.actuators.signals import CHANNEL_INDEX, State, Torque
from svsa.actuators.spring import compute_elastic_energy, compute_spring_derivatives
from svsa.analysis.design.linear_model import linearize
from svsa.control.installed import list_law_names
from svsa.runs.batch import RunSet
from svsa_server.sessions.laboratory import Laboratory
from tests.actuators.prototype import (
    NO_LOADS,
    NO_TORQUE,
    differentiate,
    integrate_ideal,
    springs,
)

NAMES = list_mechanism_names()
OTHERS = [name for name in NAMES if name != "svsa"]
EXAMPLE = Path(__file__).parents[1] / "data" / "example_actuator"
UNLOADED = ExternalLoad(0.0, 0.0, 0.0, 0.0, 0.0)

# Of an independent prototype: σ_d, load, amplitude, and of FL and NDOBC the rms errors from 8 to
# 20 s in degrees and N·m/rad, to the digits that it gave.
KNOWN = [
    ("svsa", 15, -2.0, math.radians(60), ("11.884", "1.742"), ("0.0025", "0.0001")),
    ("svsa", 60, -2.0, math.radians(60), ("10.239", "2.921"), ("0.0024", "0.0002")),
    ("qbmove", 1.5, -0.05, 0.8, ("0.166", "0.0043"), ("0.0019", "0.00002")),
    ("qbmove", 8, -0.3, 0.8, ("0.949", "0.153"), ("0.0019", "0.0001")),
    ("maccepa", 0.8, -0.05, 0.8, ("0.628", "0.0005"), ("0.0021", "0.00000")),
    ("awas2", 30, -4.0, 0.8, ("12.190", "1.342"), ("0.0019", "0.0001")),
    ("awas2", 150, -4.0, 0.8, ("9.800", "1.342"), ("0.0018", "0.0001")),
    ("leaf_spring", 20, -2.0, 0.8, ("6.181", "0.000"), ("0.0019", "0.000")),
]
STIFFNESS = {"svsa": 60.0, "qbmove": 4.0, "maccepa": 0.8, "awas2": 60.0, "leaf_spring": 20.0}


def follow(name, law, sigma, load, amplitude, **changes):
    """A run of 20 s on A cos ωt − A, which has the errors of A sin ωt and begins at rest."""
    prototype = get_mechanism(name).prototype
    motion = svsa.SinePosition(
        amplitude_rad=amplitude,
        frequency_hz=0.25,
        phase_rad=math.pi / 2,
        offset_rad=-amplitude,
        transition_s=1.0,
    )
    given = {
        "actuator": name,
        "nominal": perturb(prototype, PAPERS_INERTIA, PAPERS_DAMPING_NMS_PER_RAD),
        "stiffness": sigma,
        "position": motion,
        "loads": svsa.ConstantLoad(torque_nm=(load, 0.0, 0.0), start_s=5.0),
        "effects": svsa.IDEAL.changed(torque_limits=False),
        "duration_s": 20.0,
    }
    return svsa.simulate("4a", law, **(given | changes))


@pytest.mark.parametrize(("name", "sigma", "load", "amplitude", "fl", "ndobc"), KNOWN)
def test_errors_are_those_of_the_prototype_to_its_digits(name, sigma, load, amplitude, fl, ndobc):
    for law, known in (("fl", fl), ("ndobc", ndobc)):
        result = follow(name, law, sigma, load, amplitude)
        assert result.fault is None
        last = result.samples[8000:]
        errors = [
            float(np.sqrt(np.mean(last[:, CHANNEL_INDEX[channel]] ** 2)))
            for channel in ("position_error_rad", "stiffness_error_nm_per_rad")
        ]
        errors[0] = math.degrees(errors[0])
        for error, text in zip(errors, known, strict=True):
            assert f"{error:.{len(text.split('.')[1])}f}" == text, (law, errors)


def list_values(mechanism):
    return [*mechanism.list_elastic(mechanism.prototype), *[0.0] * MAX_ELASTIC][:MAX_ELASTIC]


@settings(max_examples=200)
@given(springs())
def test_hand_written_derivatives_of_the_svsa_are_those_of_its_energy(drawn):
    mu, phi = drawn
    mechanism = get_mechanism("svsa")
    functions = compile_energy(mechanism).functions
    K = mechanism.prototype.rotational_stiffness_nm_per_rad
    values = list_values(mechanism)
    by_hand = compute_spring_derivatives(mu, phi, K)
    # Both round: the unit of a difference is the largest value that the derivative has here.
    most = compute_spring_derivatives(mu, 0.0, K)
    for name, one, other in zip(
        by_hand._fields,
        by_hand,
        functions["compute_state"](mu, phi, *values).derivatives,
        strict=True,
    ):
        scale = max(abs(one), abs(getattr(most, name)), K)
        assert abs(one - other) <= 1e-12 * scale, name
    energy = functions["compute_energy"](mu, phi, *values)
    assert abs(energy - compute_elastic_energy(mu, phi, K)) <= 1e-12 * K / (1 - mu)


@st.composite
def places(draw, name):
    """(actuator, s, φ) inside the domain of a member."""
    mechanism = get_mechanism(name)
    limits = mechanism.limits
    sigma = draw(st.floats(limits.stiffness_min_nm_per_rad, limits.stiffness_max_nm_per_rad))
    actuator = build_actuator(mechanism.prototype, 0.0)
    s = compute_coordinate_for_stiffness(actuator, sigma)
    return actuator, s, draw(st.floats(-0.3, 0.3)), sigma


@pytest.mark.parametrize("name", NAMES)
@settings(max_examples=40)
@given(data=st.data())
def test_derivatives_are_those_of_the_torque(name, data):
    actuator, s, phi, sigma = data.draw(places(name))
    assert compute_stiffness_of(actuator, s, 0.0) == pytest.approx(sigma, rel=1e-9)
    found = compute_derivatives(actuator, s, phi)
    assert found.sigma == pytest.approx(compute_stiffness_of(actuator, s, phi), rel=1e-12)
    near = 1e-4
    for of, wrt in (
        ("torque", "sigma"),
        ("sigma", "sigma_phi"),
        ("sigma_phi", "sigma_phiphi"),
        ("sigma_mu", "sigma_phimu"),
        ("torque_mu", "sigma_mu"),
    ):
        slope = differentiate(
            lambda x, of=of: getattr(compute_derivatives(actuator, s, x), of), phi, near
        )
        assert getattr(found, wrt) == pytest.approx(slope, rel=1e-5, abs=1e-5 * abs(found.sigma))
    for of, wrt in (("torque", "torque_mu"), ("torque_mu", "torque_mumu"), ("sigma", "sigma_mu")):
        slope = differentiate(
            lambda x, of=of: getattr(compute_derivatives(actuator, x, phi), of), s, near * s
        )
        scale = max(abs(found.sigma_mu), abs(found.torque_mumu))
        assert getattr(found, wrt) == pytest.approx(slope, rel=1e-5, abs=1e-6 * scale)


def compute_stored(mechanism, actuator, x):
    """Kinetic and elastic energy, J."""
    s = compute_coordinate(actuator, x.theta2)
    elastic = compile_energy(mechanism).functions["compute_energy"](
        s, x.q - x.theta1, *list_values(mechanism)
    )
    moving = actuator.M * x.dq**2 + actuator.B1 * x.dtheta1**2 + actuator.B2 * x.dtheta2**2
    return float(elastic + 0.5 * moving)


@pytest.mark.parametrize("name", NAMES)
@settings(max_examples=40)
@given(data=st.data())
def test_power_into_the_undriven_actuator_is_that_of_its_damping(name, data):
    """d/dt (T + U) = −D q̇² − D1 θ̇1² − D2 θ̇2² ≤ 0: the energy balance and passivity."""
    mechanism = get_mechanism(name)
    actuator, s, phi, _ = data.draw(places(name))
    actuator = actuator._replace(mu0=s)
    speeds = [data.draw(st.floats(-3.0, 3.0)) for _ in range(3)]
    x = State(phi, speeds[0], 0.0, speeds[1], 0.0, speeds[2])
    a = compute_acceleration(actuator, x, Torque(0.0, 0.0), UNLOADED)
    rate = State(x.dq, a.ddq, x.dtheta1, a.ddtheta1, x.dtheta2, a.ddtheta2)
    power = differentiate(
        lambda t: compute_stored(
            mechanism, actuator, State(*(v + t * d for v, d in zip(x, rate, strict=True)))
        ),
        0.0,
        1e-6,
    )
    lost = -(actuator.D * x.dq**2 + actuator.D1 * x.dtheta1**2 + actuator.D2 * x.dtheta2**2)
    flow = abs(compute_internal_torque(actuator, x).link * x.dq) + compute_stored(
        mechanism, actuator, x
    )
    assert power == pytest.approx(lost, abs=1e-6 * (1.0 + flow))
    assert lost <= 0.0


@pytest.mark.parametrize("name", NAMES)
def test_the_undriven_actuator_comes_to_rest(name):
    mechanism = get_mechanism(name)
    sigma = STIFFNESS[name]
    actuator = build_actuator(mechanism.prototype, 0.0)
    actuator = actuator._replace(mu0=compute_coordinate_for_stiffness(actuator, sigma))
    x = State(0.05, 0.0, 0.0, 0.0, 0.0, 0.0)
    stored = [compute_stored(mechanism, actuator, x)]
    for tick in range(2000):
        x = integrate_ideal(actuator, x, NO_TORQUE, NO_LOADS, tick, 0.0005, 4)
        stored.append(compute_stored(mechanism, actuator, x))
    assert np.all(np.diff(stored) <= 1e-9 * abs(stored[0]))
    assert stored[-1] < stored[0]


@pytest.mark.parametrize("name", NAMES)
def test_a_member_states_a_source_of_every_value_and_keeps_its_contract(name):
    mechanism = get_mechanism(name)
    assert mechanism.title
    assert mechanism.source
    assert all(mechanism.sources.values())
    assert svsa.simulate("4a", actuator=name, stiffness=STIFFNESS[name], loads=(), duration_s=0.01)
    configuration = follow(name, "ndobc", STIFFNESS[name], 0.0, 0.1, duration_s=0.01).configuration
    again = svsa.Configuration(**configuration.model_dump(mode="json"))
    assert again == configuration
    assert type(again.actuator) is mechanism.parameters


@pytest.mark.parametrize("name", NAMES)
def test_lie_derivatives_hold_along_the_flow(name):
    """σ̇ of the linearization is the rate of σ along ẋ = f(x)."""
    mechanism = get_mechanism(name)
    nominal = build_actuator(mechanism.nominal, 0.0)
    s = compute_coordinate_for_stiffness(nominal, STIFFNESS[name])
    nominal = nominal._replace(mu0=s)
    x = State(0.1, 0.3, 0.05, -0.2, 0.0, 0.1)
    a = compute_acceleration(nominal, x, Torque(0.0, 0.0), UNLOADED)
    rate = (x.dq, a.ddq, x.dtheta1, a.ddtheta1, x.dtheta2, a.ddtheta2)

    def move(field):
        return differentiate(
            lambda t: getattr(
                compute_linearization(
                    nominal, State(*(v + t * d for v, d in zip(x, rate, strict=True)))
                ),
                field,
            ),
            0.0,
            1e-6,
        )

    found = compute_linearization(nominal, x)
    for of, derived in (
        ("ddq", "dddq"),
        ("dddq", "ddddq"),
        ("sigma", "dsigma"),
        ("dsigma", "ddsigma"),
    ):
        value = getattr(found, derived)
        assert value == pytest.approx(move(of), rel=1e-5, abs=1e-5 * abs(found.ddddq)), derived


@pytest.mark.long
@pytest.mark.parametrize("law", list_law_names())
def test_every_law_runs_on_another_actuator(law):
    result = follow("leaf_spring", law, 20.0, 0.0, 0.05, duration_s=0.5)
    assert result.fault is None
    assert np.isfinite(result.samples[:, CHANNEL_INDEX["torque1_nm"]]).all()


def test_many_runs_side_by_side_are_the_same_run_alone():
    runs = [follow("qbmove", "ndobc", sigma, 0.0, 0.1, duration_s=0.3) for sigma in (3.0, 5.0)]
    found = RunSet([run.configuration for run in runs]).run("ndobc", 0.3)
    for run, summary in zip(runs, found, strict=True):
        last = run.samples[-1, CHANNEL_INDEX["position_error_rad"]]
        assert summary["position_last"] == last


def build_wrong(energy, **changes):
    member = get_mechanism("leaf_spring")
    fields = {name: getattr(member, name) for name in Mechanism.__dataclass_fields__}
    return Mechanism(**(fields | {"name": "wrong", "energy": energy} | changes))


def bend(phi, s, p, m):
    return m.Abs(phi) ** 3 * s


def stay(phi, s, p, m):
    return p.bending_nm_m3 * phi**2 + s**2


def push(phi, s, p, m):
    return -p.bending_nm_m3 * s * phi**2


def turn(phi, s, p, m):
    return p.bending_nm_m3 * (2 + (s - m.Rational(1, 4)) ** 2) * phi**2


def strange(phi, s, p, m):
    return m.gamma(2 + s) * m.besselj(0, phi)


@pytest.mark.parametrize(
    ("energy", "reason"),
    [
        (bend, "it is not smooth"),
        (stay, "does not depend on s"),
        (push, "its stiffness at φ = 0 .* not > 0"),
        (turn, "is not monotonic in s"),
        (strange, "it contains the function"),
    ],
)
def test_an_energy_that_is_none_is_rejected_with_the_reason(energy, reason):
    with pytest.raises(svsa.ParameterError, match=reason):
        compile_energy(build_wrong(energy))


def test_a_member_without_a_source_is_rejected():
    with pytest.raises(svsa.ParameterError, match="missing: bending_nm_m3"):
        sources = dict(get_mechanism("leaf_spring").sources)
        del sources["bending_nm_m3"]
        build_wrong(stay, sources=sources)


def test_a_stiffness_outside_the_range_names_the_range():
    with pytest.raises(svsa.ParameterError, match=r"0\.2 to 15 N·m/rad"):
        svsa.simulate("4b", actuator="qbmove", duration_s=0.01)


def test_an_actuator_that_is_not_installed_names_those_that_are():
    with pytest.raises(svsa.ParameterError, match="svsa, awas2, leaf_spring"):
        svsa.simulate("4a", actuator="nowhere")


def test_plant_and_model_are_of_one_mechanism():
    with pytest.raises(svsa.ParameterError, match=r"nominal\.mechanism"):
        svsa.simulate("4a", nominal=get_mechanism("qbmove").nominal)


def test_a_parameter_of_another_actuator_changes_while_it_runs():
    softer = get_mechanism("leaf_spring").prototype.changed(bending_nm_m3=0.018)
    change = svsa.Change(at_s=0.1, actuator=softer)
    result = follow("leaf_spring", "ndobc", 20.0, 0.0, 0.1, duration_s=0.2, commands=(change,))
    sigma = result.samples[[50, 101], CHANNEL_INDEX["stiffness_nm_per_rad"]]
    assert sigma[1] == pytest.approx(0.9 * sigma[0], rel=0.01)


def test_what_computes_with_the_spring_of_the_svsa_rejects_another_actuator():
    configuration = follow("qbmove", "ndobc", 4.0, 0.0, 0.1, duration_s=0.01).configuration
    with pytest.raises(svsa.ParameterError, match="the lever and the spring of the SVSA"):
        linearize(4.0, design=configuration)
    lab = Laboratory.__new__(Laboratory)
    with pytest.raises(svsa.ParameterError, match="a session of the server"):
        lab.create(configuration)


def test_the_text_of_an_energy_is_written_once(tmp_path, monkeypatch):
    """The second process needs no sympy."""
    script = (
        "import sys\n"
        "from svsa.actuators.energy import compile_energy\n"
        "from svsa.actuators.installed import get_mechanism\n"
        "compile_energy(get_mechanism('leaf_spring'))\n"
        "print('sympy' in sys.modules)\n"
    )
    found = [
        subprocess.run(
            [sys.executable, "-c", script],
            env=os.environ | {"SVSA_CACHE": str(tmp_path)},
            capture_output=True,
            text=True,
            check=True,
            timeout=300,
        ).stdout.strip()
        for _ in range(2)
    ]
    assert found == ["True", "False"]
    assert "compute_state" in write_source(get_mechanism("leaf_spring"))


SCRIPT = """
import svsa
from svsa.actuators.installed import list_mechanism_names
print(",".join(list_mechanism_names()))
given = {"stiffness": 5.0, "position": 0.1, "loads": (), "duration_s": 0.5}
result = svsa.simulate("4a", "ndobc", actuator="cubic", **given)
print(result.fault is None, result.configuration.actuator.mechanism)
"""


def test_a_package_outside_adds_an_actuator(tmp_path):
    source, target = tmp_path / "source", tmp_path / "installed"
    shutil.copytree(EXAMPLE, source)
    install = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--no-index"]
    install += ["--no-build-isolation", "--disable-pip-version-check", "--target", str(target)]
    subprocess.run([*install, str(source)], check=True, timeout=300, capture_output=True)
    root = Path(svsa.__file__).parents[1]
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT],
        env=os.environ | {"PYTHONPATH": os.pathsep.join([str(target), str(root)])},
        capture_output=True,
        text=True,
        timeout=600,
    )
    assert done.returncode == 0, done.stderr
    names, found = done.stdout.split("\n")[:2]
    assert set(names.split(",")) == {*NAMES, "cubic"}
    assert found == "True cubic"

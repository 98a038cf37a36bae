"""Actuators and arms as models of other programs: MJCF (MuJoCo) and URDF.

The rotor of motor 1 turns about its own axis (Spong 1987), and a spring connects it with its link:

    M q̈ + D q̇ + τ_e = τ_ext,    B1 θ̈1 + D1 θ̇1 − τ_e = u1,    τ_e ≈ k φ + k3 φ³,  φ = q − θ1

Both formats have no motor that changes a stiffness: motor 2 rests at θ2 = 0, and the spring is that
of the start of a run. URDF has no spring either: the program that reads it applies τ_e.
"""

from typing import NamedTuple
from xml.etree.ElementTree import Comment, Element, SubElement, indent, tostring

import numpy as np

from svsa.actuators.domain import build_domain, compute_deflection_limit
from svsa.actuators.dynamics import build_actuator
from svsa.actuators.elasticity import compute_coordinate_for_stiffness, compute_torques
from svsa.actuators.installed import find_mechanism
from svsa.errors import ParameterError, Violation
from svsa.runs.definition.arm_experiment import split_joints
from svsa.runs.definition.configuration import Configuration
from svsa.simulation.reference.preview import sample_reference

FORMATS = ("mjcf", "urdf")
_POINTS = 201
_SMALL = 1e-9
"""Inertia of a body about axes that it does not turn about, or of a point mass, kg·m²."""
_LINEAR = 1e-6
"""Share of the cubic term below which a spring is linear."""
_AXIS = "0 -1 0"
"""A link hangs along −z, and a growing angle moves it towards +x."""


class Body(NamedTuple):
    """A rigid body on a joint.

    Attributes:
        name: Name of the body.
        joint: Name of its joint; empty if it is fixed.
        parent: Name of the body that it is on; empty for the base.
        origin_m: Its joint along z of the parent, m.
        center_m: Its center of mass along z, m.
        mass_kg: Mass, kg.
        inertia_kg_m2: Inertia about its center of mass, kg·m².
        damping_nms_per_rad: Damping of the joint, N·m·s/rad.
        torque_nm: Limit of the motor's torque, N·m; 0 without a motor.
    """

    name: str
    joint: str
    parent: str
    origin_m: float
    center_m: float
    mass_kg: float
    inertia_kg_m2: float
    damping_nms_per_rad: float = 0.0
    torque_nm: float = 0.0


class Spring(NamedTuple):
    """The spring of a joint: k in N·m/rad, k3 in N·m/rad³, and a description."""

    k: float
    k3: float
    description: str


def describe_robot(configuration: Configuration, file_format: str = "mjcf") -> str:
    """Describe the plant of a run for another program.

    MJCF has links, rotors, dampings, springs, gravity and the limit of u1; URDF has no springs and
    no gravity. Friction and other effects, loads and control laws are in neither.

    Args:
        configuration: A single joint or an arm.
        file_format: "mjcf" or "urdf".

    Returns:
        The XML text. Joint i has the joints q<i> (link, rad) and motor<i> (θ1, rad).

    Raises:
        ParameterError: If there is no such format.
    """
    if file_format not in FORMATS:
        raise ParameterError(Violation("file_format", file_format, "", "mjcf or urdf"))
    bodies = _list_bodies(configuration)
    springs = [_fit_spring(joint) for joint in split_joints(configuration)]
    is_urdf = file_format == "urdf"
    root = _write_urdf(bodies) if is_urdf else _write_mjcf(configuration, bodies, springs)
    for number, spring in enumerate(springs, start=1):
        root.insert(number - 1, Comment(f" spring {number}: {spring.description} "))
    indent(root)
    return tostring(root, encoding="unicode") + "\n"


def _list_bodies(configuration: Configuration) -> list[Body]:
    joints = split_joints(configuration)
    bodies = []
    dampings = [joint.actuator.link_damping_nms_per_rad for joint in joints]
    if configuration.arm is None:
        # M is the inertia about the axis; the mass is not known, and does not act.
        inertia = joints[0].actuator.link_inertia_kg_m2
        bodies.append(Body("link1", "q1", "", 0.0, 0.0, 1.0, inertia, dampings[0]))
    else:
        links = configuration.arm.links
        parent, end = "", 0.0
        for number, (a, damping) in enumerate(zip(links.chain, dampings, strict=True), start=1):
            own = a.mass_kg, a.inertia_kg_m2, damping
            bodies.append(Body(f"link{number}", f"q{number}", parent, end, -a.center_m, *own))
            parent, end = f"link{number}", -a.length_m
        if links.tip_mass_kg > 0.0:
            bodies.append(Body("tip", "", parent, end, 0.0, links.tip_mass_kg, _SMALL))
    for number, joint in enumerate(joints, start=1):
        p = joint.actuator
        own = p.motor1_inertia_kg_m2, p.motor1_damping_nms_per_rad, _find_torque_limit(joint)
        bodies.append(Body(f"rotor{number}", f"motor{number}", "", 0.0, 0.0, 1.0, *own))
    return bodies


def _find_torque_limit(joint: Configuration) -> float:
    """Return the limit of u1, N·m: two motors that pull against each other add theirs."""
    motors = 2.0 if find_mechanism(joint.actuator).antagonistic else 1.0
    return motors * joint.limits.torque1_nm


def _fit_spring(joint: Configuration) -> Spring:
    """Fit τ_e at the start of the run with k = σ, k3 by least squares of the relative error.

    The fit extends to the deflection limit, or to the deflection of the largest motor torque.
    """
    sigma = float(sample_reference(joint.stiffness, 2)[1][0, 0])
    plant = build_actuator(joint.actuator, 0.0)
    s = compute_coordinate_for_stiffness(plant, sigma)
    limit = compute_deflection_limit(build_domain(joint.actuator, joint.limits), plant, s)
    phi = np.linspace(0.0, limit, _POINTS)
    torque = np.array([compute_torques(plant, s, float(angle)).torque for angle in phi])
    phi = phi[: max(np.count_nonzero(torque <= _find_torque_limit(joint)), 2)]
    rest, cube = torque[: len(phi)] - sigma * phi, phi**3
    share = cube[1:] / torque[1 : len(phi)]
    k3 = float(share @ (rest[1:] / torque[1 : len(phi)]) / (share @ share))
    if abs(k3) * phi[-1] ** 2 < _LINEAR * sigma:
        k3 = 0.0
    error = float(np.abs(k3 * cube - rest).max())
    text = f"{sigma:g} N·m/rad at 0 rad; differs by at most {error:.2g} N·m up to {phi[-1]:.3g} rad"
    return Spring(sigma, k3, text)


def _write_mjcf(configuration: Configuration, bodies: list[Body], springs: list[Spring]) -> Element:
    root = Element("mujoco", model="svsa")
    gravity = configuration.arm.links.gravity_m_per_s2 if configuration.arm else 0.0
    period = f"{configuration.sampling.period_s:.9g}"
    option = SubElement(
        root, "option", timestep=period, integrator="RK4", gravity=f"0 0 {-gravity or 0.0:.9g}"
    )
    SubElement(option, "flag", contact="disable")
    elements = {"": SubElement(root, "worldbody")}
    motors = Element("actuator")
    for b in bodies:
        position = f"0 0 {b.origin_m:.9g}"
        body = SubElement(elements[b.parent], "body", name=b.name, pos=position)
        elements[b.name] = body
        if b.joint:
            damping = f"{b.damping_nms_per_rad:.9g}"
            SubElement(body, "joint", name=b.joint, type="hinge", axis=_AXIS, damping=damping)
        inertia = " ".join([f"{max(b.inertia_kg_m2, _SMALL):.9g}"] * 3)
        center, mass = f"0 0 {b.center_m:.9g}", f"{b.mass_kg:.9g}"
        SubElement(body, "inertial", pos=center, mass=mass, diaginertia=inertia)
        if b.torque_nm:
            limits = f"{-b.torque_nm:.9g} {b.torque_nm:.9g}"
            SubElement(motors, "motor", name=f"u_{b.joint}", joint=b.joint, ctrlrange=limits)
    tendons = SubElement(root, "tendon")
    for number, spring in enumerate(springs, start=1):
        stiffness = f"{spring.k:.9g}" + (f" 0 {spring.k3:.9g}" if spring.k3 else "")
        fixed = SubElement(
            tendons, "fixed", name=f"spring{number}", stiffness=stiffness, springlength="0"
        )
        SubElement(fixed, "joint", joint=f"q{number}", coef="1")
        SubElement(fixed, "joint", joint=f"motor{number}", coef="-1")
    root.append(motors)
    return root


def _write_urdf(bodies: list[Body]) -> Element:
    root = Element("robot", name="svsa")
    SubElement(root, "link", name="base")
    for b in bodies:
        inertial = SubElement(SubElement(root, "link", name=b.name), "inertial")
        SubElement(inertial, "origin", xyz=f"0 0 {b.center_m:.9g}")
        SubElement(inertial, "mass", value=f"{b.mass_kg:.9g}")
        own = f"{max(b.inertia_kg_m2, _SMALL):.9g}"
        own_inertia = SubElement(inertial, "inertia", ixx=own, iyy=own, izz=own)
        own_inertia.attrib.update(ixy="0", ixz="0", iyz="0")
        name, kind = (b.joint, "continuous") if b.joint else (f"{b.name}_fixed", "fixed")
        joint = SubElement(root, "joint", name=name, type=kind)
        SubElement(joint, "parent", link=b.parent or "base")
        SubElement(joint, "child", link=b.name)
        SubElement(joint, "origin", xyz=f"0 0 {b.origin_m:.9g}")
        if b.joint:
            SubElement(joint, "axis", xyz=_AXIS)
            SubElement(joint, "dynamics", damping=f"{b.damping_nms_per_rad:.9g}")
        if b.torque_nm:
            SubElement(joint, "limit", effort=f"{b.torque_nm:.9g}", velocity="1000")
    return root

"""What the view needs to know about the actuator at one instant."""

from dataclasses import dataclass


@dataclass(frozen=True)
class ActuatorPose:
    """One instant of the actuator. Angles are positive in the sense of q (Eq 1).

    position_rad: q, output link. position_reference_rad: q_d.
    motor1_position_rad: θ1, principal motor. motor2_position_rad: θ2, stiffness motor.
    lever_ratio: μ = a/R (Eq 4). stiffness_nm_per_rad: σ (Eq 3).
    torque1_nm, torque2_nm: u1, u2 as applied, after limits.
    disturbance_link_nm: w2, the torque on the link that the nominal model does not explain.
    load_mass_kg: mass hung on the link, 0 when none is (the paper's load shows as 3 kg).
    deflection_limit_rad: largest |φ| allowed at this μ, where φ = q − θ1.
    """

    position_rad: float
    position_reference_rad: float
    motor1_position_rad: float
    motor2_position_rad: float
    lever_ratio: float
    stiffness_nm_per_rad: float
    torque1_nm: float
    torque2_nm: float
    disturbance_link_nm: float
    load_mass_kg: float
    deflection_limit_rad: float

"""A planar arm of two links with an actuator in each joint: parameters, dynamics, kinematics."""

"""The actuator in 3D, drawn with viser by `svsa_scene.scene`; poses need no viser."""

from svsa_scene.pose import ActuatorPose, ComparisonPose

__all__ = ["ActuatorPose", "ComparisonPose"]

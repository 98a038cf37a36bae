"""The actuator in 3D, drawn with viser."""

from svsa_scene.pose import ActuatorPose, RivalPose
from svsa_scene.scene import ActuatorScene

__all__ = ["ActuatorPose", "ActuatorScene", "RivalPose"]

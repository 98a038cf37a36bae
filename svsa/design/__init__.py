"""What to design a controller with: the linear model, and what gains would do.

A, B, C, D = svsa.design.linearize(15.0)
plant = control.ss(*svsa.design.linearize(15.0))         # python-control
"""

from svsa.design.linear_model import LinearModel, linearize
from svsa.design.prediction import Prediction, predict

__all__ = ["LinearModel", "Prediction", "linearize", "predict"]

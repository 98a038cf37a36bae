"""Controller design: the linear model, its stability, and the effect of gains.

A, B, C, D = svsa.design.linearize(15.0)
plant = control.ss(*svsa.design.linearize(15.0))         # python-control

figure = svsa.paper.get_figure("4a").build_configuration()
svsa.design.assess(figure, 15.0).loop.poles              # of the closed loop, observer included
"""

from svsa.analysis.design.closed_loop import ClosedLoop, linearize_loop
from svsa.analysis.design.linear_model import LinearModel, linearize
from svsa.analysis.design.prediction import Prediction, predict
from svsa.analysis.design.stability import Stability, assess

__all__ = [
    "ClosedLoop",
    "LinearModel",
    "Prediction",
    "Stability",
    "assess",
    "linearize",
    "linearize_loop",
    "predict",
]

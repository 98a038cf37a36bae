"""Rounding towards −∞, of a number or of eight side by side."""

import numpy as np

floor = np.floor
"""Imported from here, because equations that are executed as plain Python
(`svsa.teaching.isolation`) use another one: with numpy the process of a law takes five times as
long to start.
"""

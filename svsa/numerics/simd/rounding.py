"""Rounding towards −∞, of a number or of eight side by side."""

import numpy as np

floor = np.floor
"""As a word of its own: equations that are read as plain Python, as in `svsa.teaching.isolation`,
take another, for numpy costs a process of a law five times what it takes to start without."""

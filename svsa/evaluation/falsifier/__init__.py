"""The falsifier: search within bounds for the load that degrades a law most, then simplify it.

found = svsa.falsify.falsify(svsa.falsify.read_adversary("impulse"))
svsa.falsify.write_scenario("worst.toml", found.scenario)
svsa.falsify.run_scenario(svsa.falsify.read_scenario("worst.toml"), ("ndobc", "esp"))
"""

from svsa.evaluation.falsifier.adversary import Adversary
from svsa.evaluation.falsifier.falsification import Falsified, falsify
from svsa.evaluation.falsifier.file import read_adversary, read_scenario, write_scenario
from svsa.evaluation.falsifier.measure import run_scenario
from svsa.evaluation.falsifier.scenario import LoadScenario

__all__ = [
    "Adversary",
    "Falsified",
    "LoadScenario",
    "falsify",
    "read_adversary",
    "read_scenario",
    "run_scenario",
    "write_scenario",
]

"""Heartbeats between processes: visible immediately, unchanged by readers."""

import math
import subprocess
import sys

from svsa.hardware.safety.heartbeat import SLOTS, Heartbeats

BEAT = """
import sys
from svsa.hardware.safety.heartbeat import Heartbeats
beats = Heartbeats.attach(sys.argv[1])
assert beats.age_s("server") < 60.0
beats.beat("loop")
beats.close()
"""


def test_slot_is_infinitely_old_before_its_first_beat() -> None:
    beats = Heartbeats.create()
    try:
        assert {beats.age_s(slot) for slot in SLOTS} == {math.inf}
        beats.beat("operator")
        assert 0.0 <= beats.age_s("operator") < 60.0
        assert beats.age_s("supervisor") == math.inf, "slots do not touch each other"
        beats.end("operator")
        assert beats.age_s("operator") == math.inf
    finally:
        beats.close()


def test_block_persists_after_the_end_of_a_beating_process() -> None:
    beats = Heartbeats.create()
    try:
        beats.beat("server")
        for _ in range(2):
            done = subprocess.run(
                [sys.executable, "-c", BEAT, beats.name], capture_output=True, text=True, timeout=60
            )
            assert (done.returncode, done.stderr) == (0, "")
        assert 0.0 <= beats.age_s("loop") < 60.0
    finally:
        beats.close()

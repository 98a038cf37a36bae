"""A law that attacks: it sends its findings in its torques, its only output."""

from pathlib import Path
from typing import NamedTuple

from svsa.actuators.dynamics import Actuator
from svsa.actuators.signals import Disturbance, Positions, Reference, State, Torque
from svsa.teaching.isolation.confinement import Bounds
from svsa.teaching.isolation.process import LawProcess, Place
from svsa.teaching.isolation.refusal import LawFaultError

ATTACKS = Path(__file__).parent / "attacks"
MODEL = Actuator(0.1, 0.02, 0.02, 0.1, 0.1, 0.1, 3.0, 0.02, 0.5, 0)
REPORTED = (
    Reference(*[0.0] * 8),
    State(*[0.0] * 6),
    Disturbance(0.0, 0.0, 0.0),
    Torque(0.0, 0.0),
    Positions(0.0, 0.0, 0.0),
)
SENT_AT_ONCE = 6
GOT, REFUSED = 2.0, 1.0
_SENDING = f"""
CLUE = {{clue!r}}
found, sent = None, 0

def law(time_s, reference, x, w):
    global found, sent
    if found is None:
        try:
            found = {{name}}(dict(CLUE)) or b""
        except Exception as error:
            found = type(error).__name__.encode()
            return {REFUSED}, float(len(found))
        return {GOT} if found else {REFUSED}, float(len(found))
    parts = [found[at:at + {SENT_AT_ONCE}] for at in (sent, sent + {SENT_AT_ONCE})]
    sent += {2 * SENT_AT_ONCE}
    return tuple(float(int.from_bytes(part, "little")) for part in parts)
"""
BOUNDS = Bounds(
    memory_bytes=256 << 20, cpu_s=5, output_bytes=1 << 16, start_s=60, answer_s=5, whole_s=60
)


class Outcome(NamedTuple):
    """ended: "refused", "got", or the code of the fault. reported: the text of the fault.

    got: the bytes that the attack sent out; for a rejected attack, the name of the error.
    """

    ended: str
    got: bytes
    reported: str = ""


def list_attacks() -> list[tuple[str, str]]:
    """Return (theme, name) of every attack."""
    found = []
    for path in sorted(ATTACKS.glob("[a-z]*.py")):
        lines = path.read_text().splitlines()
        found += [
            (path.stem, line.split("(")[0].removeprefix("def "))
            for line in lines
            if line.startswith("def ") and line.endswith("(clue):")
        ]
    return found


def attack(theme: str, name: str, clue: dict, place: Place, bounds: Bounds = BOUNDS) -> Outcome:
    """Run an attack as a law until it has no more bytes to send."""
    text = (ATTACKS / f"{theme}.py").read_text() + _SENDING.format(clue=clue, name=name)
    got = b""
    try:
        with LawProcess(text.encode(), MODEL, bounds, place) as law:
            ended, length = law(0.0, *REPORTED)
            for tick in range(1, max(3, 1 + -(-int(length) // (2 * SENT_AT_ONCE)))):
                for torque in law(1e-3 * tick, *REPORTED):
                    got += int(torque).to_bytes(SENT_AT_ONCE, "little")
            return Outcome("got" if ended == GOT else "refused", got[: int(length)])
    except LawFaultError as error:
        return Outcome(error.code, got, f"{error} {error.output}")

"""What goes between the loop and a law in a process of its own: frames of fixed length.

To the law `ASK`: kind, number, and 23 doubles, which are time (s), `Reference`, x̂ (`State`), ŵ
(`Disturbance`), the `Torque` that acted and the measured `Positions`, or once, before the first,
the constants of the nominal model. From it `ANSWER`:
kind, the number of what is answered, and two torques, N·m. Numbers are drawn at random, so
that a law cannot answer a request in advance. Imports nothing of the lab: the law's side reads this
file too.
"""

from struct import Struct

BEGIN, TICK = 1, 2
READY, TORQUE, FAILED = 3, 4, 5

DOUBLES = 23
ASK = Struct(f"<IQ{DOUBLES}d")
ANSWER = Struct("<IQ2d")

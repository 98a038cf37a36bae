"""Binary frames between the loop and the law's process, for one run or several.

To the law: `ASK` with kind, number and the number of rows, then the rows. A row is 23 doubles of
one run: time (s), `Reference`, x̂ (`State`), ŵ (`Disturbance`), the actual `Torque` and the
measured `Positions`; a NaN time marks a run that has ended. The rows of the first frame are the
constants of each run's nominal model. From the law: `ANSWER` with kind and number of the request,
then two torques of each run, N·m. Numbers are random, so that a law cannot answer a request in
advance. Imports nothing of the lab, because the law's process reads this file too.
"""

from struct import Struct

BEGIN, TICK = 1, 2
READY, TORQUE, FAILED = 3, 4, 5

DOUBLES = 23
ASK, ANSWER = Struct("<IQI"), Struct("<IQ")
ROW, PAIR = Struct(f"<{DOUBLES}d"), Struct("<2d")

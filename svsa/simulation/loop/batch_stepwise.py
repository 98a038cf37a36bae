"""Eight runs in parallel with a plain Python controller, called once a tick for all."""

import ctypes
from collections.abc import Callable, Sequence

import numpy as np

from svsa.numerics.simd.number import WIDTH
from svsa.simulation.loop.batch import Batch, pack_setups, run_batch
from svsa.simulation.loop.batch_law import WORDS, PythonLaw
from svsa.simulation.loop.deferred_signals import hold_signals
from svsa.simulation.loop.lane import Blocks, Inputs

GroupController = Callable[[float, np.ndarray, np.ndarray], np.ndarray]
"""Time (s), active runs (8,), arguments of their law (8, 22) → torques (8, 2). A row has
`Reference`, x̂ (`State`), ŵ (`Disturbance`), the mean actual `Torque` of the last period and the
measured `Positions`; an answer is (u1, u2), N·m.
"""

_Call = ctypes.CFUNCTYPE(None, ctypes.c_void_p)


def run_batch_stepwise(
    blocks: Sequence[Blocks], inputs: Inputs, controller: GroupController, ticks: int, begin: int
) -> np.ndarray:
    """Run at most eight runs from the start, bit-identical to single runs.

    Args:
        blocks: Blocks of each run; period, delay and steps are the same in all.
        inputs: Inputs of all runs, see `svsa.simulation.loop.batch_inputs.join_inputs`.
        controller: Called once per tick. A group of fewer than eight repeats its last run.
        ticks: Number of ticks.
        begin: Tick at which measuring begins.

    Returns:
        An array (runs,) of `svsa.simulation.loop.tally.SUMMARY`.

    Raises:
        BaseException: What the controller raises.
    """
    tick, raised, period = 0, list[BaseException](), blocks[0].period

    def ask(address: int) -> None:
        nonlocal tick
        words = (ctypes.c_double * (WIDTH * WORDS)).from_address(address)
        rows = np.ctypeslib.as_array(words).reshape(WIDTH, WORDS)
        given, answers = rows[:, 1:-2], rows[:, -2:]
        try:
            # An exception of a signal handler can be caught here, but not in the code of ctypes.
            held.handle()
            answers[:] = controller(tick * period, rows[:, 0] == 1.0, given)
        # ctypes prints and drops an exception of a callback; therefore it is stored, and raised
        # after the compiled call.
        except BaseException as error:
            raised.append(error)
            # NaN ends every run at this tick.
            answers[:] = np.nan
        tick += 1

    # ctypes frees the callback together with this object, so it must exist as long as the batch
    # runs.
    called = _Call(ask)
    law = PythonLaw(ctypes.cast(called, ctypes.c_void_p).value or 0)
    layout, rows = pack_setups(blocks, [law] * len(blocks), np.empty(0))
    memories = np.zeros((len(rows), WIDTH, WORDS))
    batch = Batch(None, None, layout, rows, memories, inputs, len(blocks))
    with hold_signals() as held:
        summaries = run_batch(batch, ticks, begin)
    if raised:
        raise raised[0]
    return summaries

"""Stateful control laws in Python: each run starts with a fresh copy."""

import pickle
import weakref
from collections.abc import Iterator
from contextlib import contextmanager
from types import BuiltinFunctionType, FunctionType
from typing import cast

from svsa.errors import StateError
from svsa.simulation.loop.stepwise import Controller

_changed: "weakref.WeakSet[object]" = weakref.WeakSet()
"""Objects without `reset` whose attributes a run has changed."""


@contextmanager
def begin_run(law: type[object] | Controller) -> Iterator[Controller]:
    """Provide the controller of one run.

    A class is called to create a new object. An object with a method `reset` is reset. Any other
    object is used as it is, and only once if a run changes its attributes. State in the closure of
    a function or in global variables is not detected.

    Args:
        law: A function (time, reference, x, disturbance) -> (u1, u2), an object that is called in
            the same way, or a class of such objects without constructor arguments.

    Yields:
        The function or object to call in each tick.

    Raises:
        StateError: If the object has the state of an earlier run.
    """
    if isinstance(law, type):
        yield cast(Controller, law())
        return
    reset = getattr(law, "reset", None)
    if callable(reset):
        reset()
    if callable(reset) or isinstance(law, (FunctionType, BuiltinFunctionType)):
        yield law
        return
    if law in _changed:
        name = type(law).__name__
        raise StateError(
            f"The {name} object has the state of an earlier run, so that this run would differ."
            f" Pass the class, as in simulate(…, {name}), which makes a new object for each run;"
            " give it a method reset(), which is called at the start of each run; or make a new"
            " object."
        )
    before = _read_state(law)
    try:
        yield law
    finally:
        if before is not None and before != _read_state(law):
            _changed.add(law)


def _read_state(law: object) -> bytes | None:
    """Read the attributes as bytes, or None if they cannot be compared."""
    try:
        weakref.ref(law)
        return pickle.dumps(vars(law))
    except Exception:  # attributes of a user's object may raise anything
        return None

"""The definition of a control law."""

import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal, NamedTuple

import numpy as np

from svsa.actuators.domain import Domain
from svsa.actuators.dynamics import Actuator
from svsa.control.call import BoundLaw, bind, is_measuring
from svsa.control.parameters import LawParameters
from svsa.errors import ParameterError, StateError, SvsaError, Violation
from svsa.numerics.packed import pack

EstimateSource = Literal["none", "observer", "own"]

NAME = re.compile(r"[a-z][a-z0-9_]{0,39}", re.ASCII)
_ESTIMATE = ("w2", "w4", "w6")


class LawError(StateError):
    """An installed law cannot be used."""


class Setting(NamedTuple):
    """The model and limits for which a law is built.

    Attributes:
        nominal: Constants of the nominal model.
        domain: Domain in which the model is valid.
        torque1_max: Torque limit of motor 1, N·m, infinite without a limit.
        torque2_max: Torque limit of motor 2, N·m, infinite without a limit.
        period: Control period T, s.
    """

    nominal: Actuator
    domain: Domain
    torque1_max: float
    torque2_max: float
    period: float


class Nothing(NamedTuple):
    """The constants of a law without parameters, or the memory of a law without memory."""

    nothing: float = 0.0


class NoParameters(LawParameters):
    """The parameters of a law that has none."""


@dataclass(frozen=True)
class Law:
    """A control law. The loop calls it once per period, after x̂ and ŵ, before the limits.

    `control` is a compiled function

        control(nominal, constants, memory, x, reference, estimate, applied, period) → `Torque`

    of the nominal model (`Actuator`), the constants, the memory, x̂ (`State`), `Reference`, ŵ
    (`Disturbance`, N·m), the mean actual torque of the last period (`Torque`, N·m) and T (s). It
    reads fields of nominal, constants and memory by name, and writes to memory; it stores nothing
    elsewhere. A function with a ninth argument, `measured`, receives the encoder readings
    (`Positions`). For a tick that the loop of a bench missed, it is called with predicted values,
    and its torque is not sent.

    Attributes:
        name: Letters, digits and _; used in files and in the API.
        title: Name for legends.
        summary: One sentence that describes the law.
        equation: Equation in KaTeX.
        source: Number of the paper's equation, or a citation: authors, title, journal, year, and
            doi:… if it was verified.
        control: The compiled function.
        parameters: Class of the parameters, see `LawParameters`; a law whose parameters are `Gains`
            uses those of the run.
        build: Computes the constants of `control` from parameters and `Setting`: a named tuple of
            numbers and of tuples of numbers.
        memory: Named tuple of numbers with defaults, which are the memory at the start of a run and
            after a change of the law.
        estimate: Whether the law uses no ŵ, that of the loop's observer, or its own; its own ŵ is
            stored in w2, w4, w6 at the front of the memory, and is displayed.
        rejects_feedforward: Whether the law gets no arm feedforward because it estimates the whole
            disturbance in other fields of its memory, or does not use q̈_d.

    Raises:
        ParameterError: If a field is invalid.
    """

    name: str
    title: str
    summary: str
    equation: str
    source: str
    control: Any
    parameters: type[LawParameters] = NoParameters
    build: Callable[[Any, Setting], tuple[Any, ...]] = lambda parameters, setting: Nothing()
    memory: type[tuple[Any, ...]] = Nothing
    estimate: EstimateSource = "none"
    rejects_feedforward: bool = False

    def __post_init__(self) -> None:
        if not NAME.fullmatch(self.name):
            bound = "a lowercase letter, then up to 39 lowercase letters, digits or _"
            raise ParameterError(Violation("name", self.name, "", bound))
        is_measuring(self.control)
        front = _name_front(self._start.dtype)
        if self.estimate == "own" and front[:3] != _ESTIMATE:
            bound = "w2, w4, w6 at the front for a law with an estimate of its own"
            raise ParameterError(Violation("memory", list(front), "", bound))

    @property
    def takes_feedforward(self) -> bool:
        """Whether the law may receive the arm feedforward: no ŵ of its own, and not rejected."""
        return self.estimate != "own" and not self.rejects_feedforward

    @cached_property
    def _start(self) -> np.ndarray:
        return pack(self.memory())

    def start_memory(self) -> np.ndarray:
        """Return the initial memory of a run.

        Returns:
            The fields of `memory` as words of 64 bits, shape (n,).
        """
        return self._start.view(np.float64).copy()

    def bind(self, parameters: LawParameters, setting: Setting) -> BoundLaw:
        """Bind the law for the compiled loop; compiles it if necessary.

        Args:
            parameters: Parameters of the law.
            setting: Model, gains, observer, limits and period that the law receives.

        Returns:
            The compiled law with its constants.

        Raises:
            LawError: If the code of the law fails to compile.
        """
        return self.bind_packed(pack(setting.nominal), self.pack_constants(parameters, setting))

    def pack_constants(self, parameters: LawParameters, setting: Setting) -> np.ndarray:
        """Compute the constants of `control`, without compiling the law.

        Args:
            parameters: Parameters of this law.
            setting: Model and limits for which the law is built.

        Returns:
            One packed record, shape (1,).

        Raises:
            LawError: If the law's `build` fails.
        """
        with self._blame():
            return pack(self.build(parameters, setting))

    def bind_packed(self, nominal: np.ndarray, constants: np.ndarray) -> BoundLaw:
        """Bind the law to packed constants; compile it if their layout is new.

        Args:
            nominal: The nominal model, packed, shape (1,).
            constants: As `pack_constants` returns them.

        Returns:
            The law as the compiled loop calls it.

        Raises:
            LawError: If the law does not compile.
        """
        with self._blame():
            return bind(self.control, nominal, constants, self._start, self.estimate == "own")

    @contextmanager
    def _blame(self) -> Iterator[None]:
        """Raise an error of the law's own code as `LawError` with the law's name."""
        try:
            yield
        except SvsaError:
            raise
        except Exception as error:
            first, *_ = str(error).strip().split("\n")
            reason = f"{type(error).__name__}: {first}"
            raise LawError(f"The law {self.name} does not compile: {reason}") from error


def _name_front(memory: np.dtype) -> tuple[str, ...]:
    """Name the leading numbers of a memory by the tuple at its beginning."""
    names = memory.names or ()
    first = memory[names[0]] if names else memory
    return _name_front(first) if first.names else names

"""The definition of a control law: everything that the lab knows about it."""

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
    """What a law is set up for. nominal: constants of the model. domain: where it is valid.

    torque1_max, torque2_max: N·m, infinite where nothing limits. period: T, s.
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
    """A control law. The loop calls it once a period, after x̂ and ŵ, before the limits.

    name: letters, digits and _, as in files and on the wire. title: as in a legend. summary: what
    it does, in a sentence. equation: KaTeX. source: number of the paper's equation, or what
    to cite: authors, title, journal, year, and doi:… where it has been looked up.
    parameters: see `LawParameters`; a law whose parameters are `Gains` takes those of the run.
    build: the constants of `control` from them, a named tuple of numbers and of tuples of numbers.
    control: a compiled function

        control(nominal, constants, memory, x, reference, estimate, applied, period) → `Torque`

    of the nominal model (`Actuator`), the constants, the memory, x̂ (`State`), `Reference`, ŵ
    (`Disturbance`, N·m), the mean torque that really acted in the last period (`Torque`, N·m) and
    T (s); nominal, constants and memory are read by name, and memory is written. One that takes a
    ninth argument, `measured`, receives the encoder readings (`Positions`). It stores nothing
    elsewhere. For a tick that a bench's loop missed it receives what the model expects, and what it
    asks for then is not sent. memory: a named tuple of numbers with defaults, which are what it
    remembers at the start of a run and after another law. estimate: whether it acts on no ŵ, on
    that of the loop's observer, or brings its own, which stands in w2, w4, w6 at the front of its
    memory and is what is shown. Raises `ParameterError` for what is no law.
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

    def __post_init__(self) -> None:
        if not NAME.fullmatch(self.name):
            bound = "a small letter, then up to 39 small letters, digits or _"
            raise ParameterError(Violation("name", self.name, "", bound))
        is_measuring(self.control)
        front = _name_front(self._start.dtype)
        if self.estimate == "own" and front[:3] != _ESTIMATE:
            bound = "w2, w4, w6 at the front for a law with an estimate of its own"
            raise ParameterError(Violation("memory", list(front), "", bound))

    @cached_property
    def _start(self) -> np.ndarray:
        return pack(self.memory())

    def start_memory(self) -> np.ndarray:
        """Return the initial memory, as words of 64 bits."""
        return self._start.view(np.float64).copy()

    def bind(self, parameters: LawParameters, setting: Setting) -> BoundLaw:
        """Bind the law for the compiled loop; compiles it if necessary.

        Raises `LawError` where the law's own code fails at it.
        """
        return self.bind_packed(pack(setting.nominal), self.pack_constants(parameters, setting))

    def pack_constants(self, parameters: LawParameters, setting: Setting) -> np.ndarray:
        """Compute the constants of `control`, without compiling anything of the law.

        Args:
            parameters: Of this law.
            setting: What the law is set into.

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
            reported = f"{type(error).__name__}: {first}"
            raise LawError(f"The law {self.name} does not compile: {reported}") from error


def _name_front(memory: np.dtype) -> tuple[str, ...]:
    """Name the leading numbers of a memory by the tuple at its beginning."""
    names = memory.names or ()
    first = memory[names[0]] if names else memory
    return _name_front(first) if first.names else names

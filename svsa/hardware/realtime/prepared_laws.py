"""The laws of a bench's loop, compiled and loaded before READY, so that a tick only looks them up.

Importing, compiling or loading a law takes 10 to 100 ms, and so do the constants of some laws (LQI
solves twenty Riccati equations), but a tick lasts 1 ms. Therefore the loop's process loads every
law before its first tick. Missing constants are computed by the server's process.
"""

import json
from typing import Any

import numpy as np

from svsa.actuators.domain import Domain
from svsa.actuators.elasticity import Actuator, ElasticActuator
from svsa.actuators.energy import compile_energy
from svsa.actuators.installed import get_mechanism
from svsa.actuators.parameters import SVSA, get_mechanism_name
from svsa.control.call import BoundLaw
from svsa.control.installed import get_law
from svsa.control.law import LawError, Setting
from svsa.control.parameters import LawParameters
from svsa.errors import StateError
from svsa.numerics.packed import pack
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.design import Lane
from svsa.runs.execution.blocks import build_setting
from svsa.simulation.loop.lane import Blocks

MAX_BOUND = 256
"""Number of bound laws that are kept: the most recently used."""
_RESTART = "Restart the loop of the bench when it is corrected."

_KEY = ("law", "parameters", "setting")


class UnpreparedLawError(StateError):
    """The loop lacks the constants of a law.

    Attributes:
        wanted: Arguments of `compute_constants`, as JSON values.
    """

    def __init__(self, arguments: dict[str, Any]) -> None:
        self.arguments = arguments
        super().__init__(
            f"The law {arguments['law']} is not prepared for its parameters: send the"
            " command again."
        )


class PreparedLaws:
    """Binds laws for the loop; after `close`, only prepared ones.

    Attributes:
        refused: Why a law cannot be used on this bench, by name of the law.
    """

    def __init__(self) -> None:
        self.refused: dict[str, str] = {}
        self._bound: dict[tuple[str, str, Setting], BoundLaw] = {}
        self._layouts: dict[tuple[str, str], tuple[np.dtype, np.dtype]] = {}
        self._is_closed = False

    def close(self) -> None:
        """Forbid imports, compilation and computation of constants from now on."""
        self._is_closed = True

    def bind(self, configuration: Configuration, lane: Lane, blocks: Blocks) -> BoundLaw:
        """Bind the law of one lane, as `svsa.runs.execution.blocks.bind_law` does.

        Args:
            configuration: Configuration of the run.
            lane: Law and parameters.
            blocks: Blocks of the lane.

        Returns:
            The law as the compiled loop calls it.

        Raises:
            LawError: If the law cannot be used on this bench.
            UnpreparedLawError: If its constants must be computed first.
        """
        if self._is_closed and lane.law in self.refused:
            reason = self.refused[lane.law]
            raise LawError(f"The law {lane.law} is not ready on this bench. {reason} {_RESTART}")
        parameters, setting = configuration.get_parameters(lane), build_setting(blocks)
        key = lane.law, parameters.model_dump_json(), setting
        # Removed and inserted again at the end: the dictionary is ordered by last use, and `_keep`
        # drops the first entry.
        bound = self._bound.pop(key, None)
        if bound is None and self._is_closed:
            arguments = dict(zip(_KEY, key, strict=True))
            mechanism = get_mechanism_name(configuration.nominal)
            raise UnpreparedLawError({**arguments, "mechanism": mechanism})
        self._keep(key, bound or self._load(lane.law, parameters, setting))
        return self._bound[key]

    def add(self, computed: dict[str, Any]) -> None:
        """Add constants computed by another process.

        Args:
            computed: Result of `compute_constants`.

        Raises:
            LawError: If the law is not compiled for constants of this layout.
        """
        name, setting = computed["law"], _read_setting(computed)
        layout = self._layouts.get((name, computed["layout"]))
        if layout is None:
            raise LawError(
                f"The law {name} is not compiled for constants of this layout on this bench: its"
                " parameters decide how many numbers it has. Use parameters that leave the layout"
                " as it was when the loop was started."
            )
        # As bits: the constants are integers and floats, and JSON stores integers exactly.
        words = np.array(computed["constants"], np.uint64)
        bound = get_law(name).bind_packed(pack(setting.nominal), words.view(layout[1]))
        self._keep((name, computed["parameters"], setting), bound)

    def _load(self, name: str, parameters: LawParameters, setting: Setting) -> BoundLaw:
        law, nominal = get_law(name), pack(setting.nominal)
        constants = law.pack_constants(parameters, setting)
        bound = law.bind_packed(nominal, constants)
        layout = _describe_layout(nominal, constants)
        self._layouts[name, layout] = nominal.dtype, constants.dtype
        return bound

    def _keep(self, key: tuple[str, str, Setting], bound: BoundLaw) -> None:
        self._bound[key] = bound
        if len(self._bound) > MAX_BOUND:
            del self._bound[next(iter(self._bound))]


def compute_constants(arguments: dict[str, Any]) -> dict[str, Any]:
    """Compute the constants of a law that a loop lacks, outside the loop's process.

    Args:
        arguments: `arguments` of an `UnpreparedLawError`.

    Returns:
        `arguments` with the constants, for `PreparedLaws.add`.

    Raises:
        LawError: If the code of the law fails.
    """
    law, setting = get_law(arguments["law"]), _use_own_addresses(arguments)
    parameters = law.parameters(**json.loads(arguments["parameters"]))
    constants = law.pack_constants(parameters, setting)
    layout = _describe_layout(pack(setting.nominal), constants)
    return {**arguments, "layout": layout, "constants": constants.view(np.uint64).tolist()}


def _read_setting(arguments: dict[str, Any]) -> Setting:
    nominal, domain, *others = arguments["setting"]
    kind: Any = Actuator if arguments["mechanism"] == SVSA else ElasticActuator
    return Setting(kind(*nominal), Domain(*domain), *others)


def _use_own_addresses(arguments: dict[str, Any]) -> Setting:
    """Read the setting for this process: the addresses of an energy are those of the loop's."""
    setting, mechanism = _read_setting(arguments), arguments["mechanism"]
    if mechanism == SVSA:
        return setting
    own = compile_energy(get_mechanism(mechanism)).addresses
    nominal = setting.nominal._replace(
        torques_address=own["compute_torques"],
        margin_address=own["compute_margin"],
        state_address=own["compute_state"],
    )
    return setting._replace(nominal=nominal)


def _describe_layout(nominal: np.ndarray, constants: np.ndarray) -> str:
    return f"{nominal.dtype.descr} {constants.dtype.descr}"

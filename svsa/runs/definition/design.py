"""The design of a run, as a parameter file has it, and the controllers of its lanes."""

from typing import Any, Self

from pydantic import ValidationInfo, field_validator, model_validator

from svsa.actuators.installed import InstalledActuator
from svsa.actuators.parameters import Limits, get_mechanism_name
from svsa.control.gains import Gains
from svsa.control.installed import (
    LaneParameters,
    LawName,
    ParametersByLaw,
    get_law,
    has_own_parameters,
    read_parameters,
)
from svsa.control.observers.disturbance import ObserverBandwidth
from svsa.control.parameters import LawParameters
from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import Checked, Number, Whole, quantity

MAX_LANES = 4


class Sampling(Checked):
    """The sampling of the loop."""

    period_s: Number = quantity("s", "Control period T, zero-order hold", ge=1e-4, le=0.02)


class Design(Checked):
    """The content of a parameter file: plant, nominal model, gains, laws, observer, limits,
    sampling.
    """

    actuator: InstalledActuator
    nominal: InstalledActuator
    gains: Gains
    parameters: ParametersByLaw = quantity(
        "",
        "Parameters of laws that have their own, by the law's name; else its defaults",
        default={},
    )
    observer: ObserverBandwidth
    limits: Limits
    sampling: Sampling

    @model_validator(mode="after")
    def _check_mechanism(self) -> Self:
        of_plant, of_model = map(get_mechanism_name, (self.actuator, self.nominal))
        if of_plant != of_model:
            bound = f"{of_plant}, as that of the actuator"
            raise ParameterError(Violation("nominal.mechanism", of_model, "", bound))
        return self

    def find_parameters(self, lane: "Lane") -> LawParameters | None:
        """Return the parameters that were set for a lane's law.

        Args:
            lane: A lane of a run with this design.

        Returns:
            The lane's parameters, otherwise those of the design, otherwise None.
        """
        if has_own_parameters(lane.law):
            return lane.parameters or self.parameters.get(lane.law)
        return lane.gains or self.gains

    def get_parameters(self, lane: "Lane") -> LawParameters:
        """Return the parameters of a lane's law: the lane's, the design's, or the defaults.

        Args:
            lane: A lane of a run with this design.

        Returns:
            The parameters.

        Raises:
            ParameterError: If the law is not installed and no parameters are set.
        """
        parameters = self.find_parameters(lane)
        return get_law(lane.law).parameters() if parameters is None else parameters


class Lane(Checked):
    """A controller with its own plant: same references, loads and noise as the others."""

    law: LawName = quantity("", "Name of an installed law")
    gains: Gains | None = quantity(
        "", "Gains of a law that uses them (FL, NDOBC); by default those of the run", default=None
    )
    parameters: LaneParameters = quantity(
        "", "Parameters of a law that has its own; by default those of the run", default=None
    )
    observer: ObserverBandwidth | None = quantity(
        "", "Observer bandwidth; by default that of the run", default=None
    )

    @field_validator("parameters")
    @classmethod
    def _read_parameters(cls, parameters: Any, info: ValidationInfo) -> LawParameters | None:
        law = info.data.get("law")
        return parameters if parameters is None or law is None else read_parameters(law, parameters)

    def controlled_by(self, law: str) -> Self:
        """Return the lane with another law: gains and observer are kept, parameters are not.

        Args:
            law: Name of the law.

        Returns:
            The lane; itself if it already has this law.
        """
        return self if law == self.law else self.changed(law=law, parameters=None)


class LaneSetting(Checked):
    """The controller of a comparison lane."""

    lane: Whole = quantity("", "Number of the lane; 1 is the run's own", ge=2, le=MAX_LANES)
    setting: Lane

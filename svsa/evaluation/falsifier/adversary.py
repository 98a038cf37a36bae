"""An adversary as a value: permitted loads, permitted perturbations, and the cost."""

from collections.abc import Sequence
from typing import Annotated, Any, Literal, Self

import numpy as np
from pydantic import Field, model_validator

from svsa.control.installed import PAPERS_LAW, InstalledLaw
from svsa.errors import ParameterError, Violation, settle_number
from svsa.evaluation.falsifier.load_terms import DIGITS, Terms, admits, build_load
from svsa.evaluation.falsifier.scenario import Attack, check_load_count
from svsa.evaluation.studies.setting import read_setting
from svsa.evaluation.studies.study import FIGURE, build_base, check_measured, check_variation, scale
from svsa.evaluation.studies.variation import DRAWN, Variation
from svsa.inputs.checked import Checked, Number, quantity
from svsa.runs.definition.configuration import Configuration
from svsa.runs.records.former_words import SEARCHES, translate_fields

Cost = Literal["fault", "peak", "recovery"]


class Adversary(Checked):
    """Bounds on loads and perturbations that may degrade a law.

    Attributes:
        title: Title of the adversary.
        law: Law under test.
        cost: Failure criterion: a fault, the largest position error, or the longest recovery; a
            fault counts as worse than each of these.
        base: Base experiment, as in a study.
        duration_s: Duration of a run, s.
        measure_from_s: Time at which measuring begins, s.
        terms: Loads that are combined.
        vary: Perturbed settings, as in a study, but without grids; the values of the base are
            nominal.

    Raises:
        ParameterError: If a field is invalid.
    """

    title: str = quantity("", "Permitted actions of the adversary", title="Title", max_length=200)
    law: InstalledLaw = quantity("", "Law under test", default=PAPERS_LAW)
    cost: Cost = quantity(
        "",
        "A fault has a higher cost than any error or recovery time",
        title="Failure criterion",
        choices={"fault": "a fault", "peak": "peak error", "recovery": "recovery time"},
        default="fault",
    )
    base: dict[str, Any] = quantity("", "Initial settings of all runs", default={FIGURE: "4a"})
    duration_s: Number = quantity(
        "s", "Duration of a run", title="Length of a run", gt=0, le=60, default=10.0
    )
    measure_from_s: Number = quantity(
        "s", "Start of the measured window", title="Measured from", ge=0, default=0.0
    )
    terms: Terms = quantity("", "Loads that the adversary may apply", title="Search space: loads")
    vary: Annotated[tuple[Variation, ...], Field(max_length=16)] = quantity(
        "", "Settings that the adversary may perturb", title="Perturbed settings", default=()
    )

    @model_validator(mode="before")
    @classmethod
    def _translate(cls, written: Any) -> Any:
        return translate_fields(written, SEARCHES)

    @model_validator(mode="after")
    def _check(self) -> Self:
        check_measured(self.measure_from_s, self.duration_s)
        for number, term in enumerate(self.terms):
            if not term.start_s[1] < self.duration_s:
                bound = f"before the run's end, {self.duration_s:g} s"
                name = f"terms[{number}].start_s"
                raise ParameterError(Violation(name, list(term.start_s), "s", bound))
        base = build_base(self.base, self.law)
        check_load_count(len(base.loads) + len(self.terms))
        for number, variation in enumerate(self.vary):
            if not isinstance(variation, DRAWN):
                bound = "uniform, log_uniform, normal or choice, for an adversary"
                raise ParameterError(Violation(f"vary[{number}].kind", variation.kind, "", bound))
            check_variation(base, variation, f"vary[{number}]")
        return self

    @property
    def size(self) -> int:
        """Number of search variables."""
        return sum(len(term.axes) for term in self.terms) + len(self.vary)

    def build_base(self) -> Configuration:
        """Build the run without the adversary's loads and perturbations.

        Returns:
            The configuration of the base experiment under the law.
        """
        return build_base(self.base, self.law)

    def build_attack(self, base: Configuration, shares: Sequence[float]) -> Attack:
        """Build the attack at a point of the search space.

        Args:
            base: Result of `build_base`.
            shares: Position within each range, 0 to 1, shape (`size`,).

        Returns:
            The loads and settings of the attack.
        """
        loads, at = [], 0
        for term in self.terms:
            axes = term.axes
            own = shares[at : at + len(axes)]
            values = [axis.compute_value(share) for axis, share in zip(axes, own, strict=True)]
            loads.append(build_load(term, values))
            at += len(axes)
        settings = {
            variation.path: _draw(variation, read_setting(base, variation.path), share)
            for variation, share in zip(self.vary, shares[at:], strict=True)
        }
        return Attack(tuple(loads), settings)

    def admits(self, attack: Attack) -> bool:
        """Report whether an attack is within the bounds.

        Args:
            attack: Loads and settings.

        Returns:
            Whether every load is within the bounds of a term.
        """
        return all(any(admits(term, load) for term in self.terms) for load in attack.loads)


def _draw(variation: Variation, present: Any, share: float) -> Any:
    """Return a setting's value at a share of its range."""
    (drawn,) = variation.draw(np.array([share]))
    value = scale(variation, present, drawn)
    return settle_number(value, DIGITS) if isinstance(value, float) else value

"""Files of tuned laws: provenance and values, as used by the ranking."""

from collections.abc import Iterator
from functools import cache
from pathlib import Path

from svsa.errors import ParameterError, Violation
from svsa.evaluation.campaign.results_file import read_results_file, write_results_file
from svsa.evaluation.tuning.judge import find_noise_limit
from svsa.evaluation.tuning.search_space import build_space
from svsa.evaluation.tuning.tuner import Tuned
from svsa.inputs.checked import Checked, Number, Whole, quantity
from svsa.inputs.extras import __version__
from svsa.runs.definition.design import Design
from svsa.runs.definition.design_file import load_prototype

FOLDER = Path(__file__).parent / "tuned"


class Costs(Checked):
    """The costs of parameters on the validation trials."""

    cost: Number = quantity("1", "Mean over the trials; above the noise limit 5 and more")
    held: Whole = quantity("", "Successful trials", ge=0)
    torque_variation_nm_per_s: Number | None = quantity(
        "N·m/s", "Total variation of u1 at rest; None for a fault at rest"
    )


class TunedLaw(Checked):
    """The result of one tuning for the ranking."""

    law: str = quantity("", "Name of the law")
    version: str = quantity("", "Version of the lab that tuned it")
    method: str = quantity("", "Search method of the parameters")
    candidates: Whole = quantity("", "Number of candidates evaluated", ge=0)
    trials: Whole = quantity("", "Training trials of each candidate, half of each family", ge=1)
    validation: Whole = quantity("", "Validation trials of the best ten", ge=1)
    seed: Whole = quantity("", "Seed of search, training and validation trials", ge=0)
    noise_limit_nm_per_s: Number = quantity("N·m/s", "Limit of the torque variation at rest")
    before: Costs = quantity("", "Initial parameters of the search")
    after: Costs = quantity("", "The tuned parameters")
    values: dict[str, Number] = quantity("", "Tuned values by name")

    def build_design(self) -> Design:
        """Build the prototype's design with the tuned values.

        Raises:
            ParameterError: If the law no longer has these parameters.
        """
        return build_space(self.law).set_design(load_prototype(), self.read_values())

    def read_values(self) -> tuple[float, ...]:
        """The tuned values in the order of the law's search space; raises as `build_design`."""
        labels = [axis.label for axis in build_space(self.law).axes]
        if labels != list(self.values):
            raise ParameterError(Violation("values", [*self.values], "", f"those of {labels}"))
        return tuple(self.values.values())


def build_tuned_law(tuned: Tuned) -> TunedLaw:
    """Build the file's content from a complete search."""
    before, after = (
        Costs(
            cost=candidate.judgment.cost,
            held=candidate.judgment.held,
            torque_variation_nm_per_s=(
                variation
                if (variation := candidate.judgment.torque_variation_nm_per_s) < 1e9
                else None
            ),
        )
        for candidate in (tuned.finals[0], tuned.best)
    )
    labels = [axis.label for axis in tuned.space.axes]
    return TunedLaw(
        law=tuned.space.law,
        version=__version__,
        method="CMA-ES",
        candidates=tuned.budget,
        trials=tuned.trials,
        validation=tuned.validation,
        seed=tuned.seed,
        noise_limit_nm_per_s=find_noise_limit(),
        before=before,
        after=after,
        values=dict(zip(labels, tuned.best.values, strict=True)),
    )


def write_tuned_law(folder: Path, tuned: TunedLaw) -> None:
    """Write LAW.json into a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    write_results_file(folder / f"{tuned.law}.json", tuned)


def list_tuned_laws(folder: Path = FOLDER) -> Iterator[TunedLaw]:
    """List the tuned laws in a folder.

    Raises:
        ParameterError: If a file is invalid.
    """
    for path in sorted(folder.glob("*.json")):
        yield read_results_file(TunedLaw, path, "svsa tune --all", "tuned law")


@cache
def load_tuned_laws() -> dict[str, TunedLaw]:
    """Load the tuned laws of the published ranking, by name."""
    return {tuned_law.law: tuned_law for tuned_law in list_tuned_laws()}

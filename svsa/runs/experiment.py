"""What a run begins from: a figure of the paper or a configuration, and what is changed of it."""

from pathlib import Path
from typing import Any

from svsa.runs.configuration import Configuration, Design, read_design
from svsa.runs.paper import get_simulated_figure


def build_experiment(
    experiment: str | Configuration,
    parameters: Design | Path | str | None = None,
    **changes: Any,
) -> Configuration:
    """The configuration of an experiment.

    Args:
        experiment: A figure of the paper ("4a", "4b", "5") or a `Configuration`.
        parameters: A parameter file, such as `svsa identify` writes, or its `Design`, instead of
            the experiment's own.
        **changes: Fields of the configuration to replace.

    Raises:
        ParameterError: There is no such figure or field, or a value is out of range.
    """
    if isinstance(experiment, Configuration):
        configuration = experiment
    else:
        configuration = get_simulated_figure(experiment).build_configuration()
    if parameters is not None:
        design = parameters if isinstance(parameters, Design) else read_design(parameters)
        configuration = configuration.with_design(design)
    return configuration.changed(**changes)

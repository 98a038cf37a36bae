"""What a run begins from: a figure of the paper or a configuration, and what is changed of it."""

import inspect
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from svsa.runs.configuration import Configuration, Design, read_design
from svsa.runs.paper import get_simulated_figure
from svsa.runs.shorthand import change_configuration


def build_experiment(
    experiment: str | Configuration,
    parameters: Design | Path | str | None,
    given: Mapping[str, Any],
    caller: Callable[..., Any],
) -> Configuration:
    """The configuration of an experiment.

    Args:
        experiment: A figure of the paper ("4a", "4b", "5") or a `Configuration`.
        parameters: A parameter file, such as `svsa identify` writes, or its `Design`, instead of
            the experiment's own.
        given: What is changed, as `svsa.runs.shorthand.Settings`.
        caller: What the user called: a wrong name may have meant another of its keywords.

    Raises:
        ParameterError: There is no such figure or setting, or a value is out of range.
    """
    if isinstance(experiment, Configuration):
        configuration = experiment
    else:
        configuration = get_simulated_figure(experiment).build_configuration()
    if parameters is not None:
        design = parameters if isinstance(parameters, Design) else read_design(parameters)
        configuration = configuration.with_design(design)
    return change_configuration(configuration, given, inspect.signature(caller).parameters)

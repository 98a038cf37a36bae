"""`svsa export-model`: an actuator or an arm as MJCF or URDF."""

from pathlib import Path
from typing import Annotated

import typer


def export_model(
    name: Annotated[str, typer.Argument(help="Installed actuator; with --arm, an arm of the lab.")],
    is_arm: Annotated[bool, typer.Option("--arm", help="NAME is an arm, such as rods.")] = False,
    file_format: Annotated[
        str, typer.Option("--format", help="mjcf (with springs), or urdf (rigid bodies only).")
    ] = "mjcf",
    stiffness: Annotated[
        float | None,
        typer.Option(help="Constant stiffness, N·m/rad; default: that of the experiment."),
    ] = None,
    output: Annotated[Path | None, typer.Option(help="File to write; default: print it.")] = None,
) -> None:
    """Describe the plant of an actuator or an arm for MuJoCo (MJCF) or other programs (URDF)."""
    from svsa.analysis.exchange.robot_model import describe_robot
    from svsa.control.installed import PAPERS_LAW
    from svsa.runs.definition.arm_experiment import build_arm_experiment
    from svsa.runs.definition.experiment import build_actuator_experiment
    from svsa.runs.definition.shorthand import change_configuration

    changes = {} if stiffness is None else {"stiffness": stiffness}
    if is_arm:
        configuration = build_arm_experiment(name, {}, changes)
    else:
        experiment = build_actuator_experiment(name, PAPERS_LAW, False)
        configuration = change_configuration(experiment, changes)
    text = describe_robot(configuration, file_format)
    if output is None:
        typer.echo(text, nl=False)
    else:
        output.write_text(text, encoding="utf-8")

"""Answers about laws: the descriptions that forms and legends need."""

from typing import Annotated, Any

from pydantic import AfterValidator, BaseModel, Field

from svsa.control.installed import (
    LawError,
    check_installed,
    get_law,
    get_notes,
    has_own_parameters,
    list_law_line_styles,
)
from svsa.control.law import EstimateSource
from svsa.errors import ParameterError
from svsa.runs.definition.design import Lane
from svsa_server.problems import ShownText
from svsa_server.schemas.lab.parameter import ParameterState, list_parameters


def _check_lane(lane: Lane) -> Lane:
    try:
        check_installed(lane.law)
    except ParameterError as error:
        raise error.within("law") from None
    return lane


InstalledLane = Annotated[Lane, AfterValidator(_check_lane)]
"""A lane whose law is installed."""


class LawState(BaseModel):
    """An installed law, described by its own file."""

    name: str
    title: str
    line_style: int = Field(description="Preferred line style of its curves, from 0")
    summary: str
    equation: str = Field(description="KaTeX")
    source: str = Field(description="Number of the paper's equation, a citation, or empty")
    notes: str = Field(description="Idea, equations and limits in words, or empty")
    estimate: EstimateSource = Field(description="Source of the estimate ŵ that it uses")
    takes_gains: bool = Field(description="Whether its parameters are the session's gains (Eq 25)")
    parameters: list[ParameterState] = Field(
        description="Parameters of the law; none if it uses gains"
    )
    problem: ShownText | None = Field(description="Why the law cannot be used; null if it can")


def list_laws() -> list[LawState]:
    """List every installed law; one that does not load has the reason."""
    return [_describe(name, line_style) for name, line_style in list_law_line_styles().items()]


def _describe(name: str, line_style: int) -> LawState:
    try:
        law, is_own = get_law(name), has_own_parameters(name)
    except LawError as error:
        own: dict[str, Any] = dict.fromkeys(("summary", "equation", "source", "notes"), "")
        own |= {"title": name, "estimate": "none", "takes_gains": False, "parameters": []}
        return LawState(**own, name=name, line_style=line_style, problem=str(error))
    own = vars(law) | {
        "line_style": line_style,
        "notes": get_notes(name),
        "takes_gains": not is_own,
        "parameters": list_parameters(law.parameters) if is_own else [],
    }
    return LawState(**own, problem=None)

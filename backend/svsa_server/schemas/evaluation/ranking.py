"""The ranking on the wire."""

from typing import Annotated

from pydantic import BaseModel, Field


class ScenarioRequest(BaseModel):
    """A row in a scenario of the ranking."""

    row: Annotated[
        str, Field(max_length=64, description="Key of a row: a law's name, or ndobc_declared")
    ]
    scenario: Annotated[
        str,
        Field(max_length=60, description="Name of the run: rig_4a.negative.0, or trial_A_12"),
    ]

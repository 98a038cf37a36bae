"""What goes over the wire about the ranking."""

from typing import Annotated

from pydantic import BaseModel, Field

from svsa.control.installed import InstalledLaw
from svsa.evaluation.ranking.row import Row


class ScenarioRequest(BaseModel):
    """A law in a scenario of the suite."""

    law: InstalledLaw
    scenario: Annotated[
        str, Field(max_length=60, description="Name of the run, such as rig_4a or trial_12")
    ]


class MeasuredRow(BaseModel):
    """A row that this lab has just measured."""

    row: Row
    is_published: bool = Field(description="Whether every number agrees with the published row")

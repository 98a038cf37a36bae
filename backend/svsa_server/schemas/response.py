"""The base class of answers."""

from typing import Annotated

from pydantic import BaseModel, BeforeValidator, ConfigDict

TextOrNull = Annotated[str | None, BeforeValidator(lambda text: text or None)]
"""A text of the library; an empty one is null."""


class ResponseModel(BaseModel):
    """An answer. A field is read from the attribute or property of its name.

    A route, or a field of this type, may therefore get an object of the library directly.
    """

    model_config = ConfigDict(from_attributes=True)

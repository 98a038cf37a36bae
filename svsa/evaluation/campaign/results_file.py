"""Results of a campaign in a JSON file, to which a command adds rows."""

from pathlib import Path
from typing import TypeVar

from pydantic import BaseModel

from svsa.errors import ParameterError, Violation
from svsa.inputs.stored_file import read_file
from svsa.runs.records.header import replace_file

M = TypeVar("M", bound=BaseModel)


def read_results_file(kind: type[M], path: Path, command: str, name: str = "results") -> M:
    """Read the results of a command.

    Args:
        kind: Class of the results.
        path: The file.
        command: Command that writes such files, for the message.
        name: Setting that contains the path, for the message.

    Returns:
        The results.

    Raises:
        ParameterError: If the file cannot be read, or is not one of this command.
    """
    try:
        return kind.model_validate_json(read_file(path))
    except (OSError, ValueError) as error:
        bound = f"a file that {command} writes ({str(error).partition(chr(10))[0]})"
        raise ParameterError(Violation(name, path, "", bound)) from None


def write_results_file(path: Path, results: BaseModel) -> None:
    """Write results; an interruption leaves the former ones.

    Args:
        path: The file.
        results: What `read_results_file` returns.

    Raises:
        OSError: If the file cannot be written.
    """
    replace_file(path, (results.model_dump_json(indent=1) + "\n").encode())

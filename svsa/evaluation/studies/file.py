"""Study files, TOML or Python, and the built-in studies."""

import runpy
import traceback
from pathlib import Path
from typing import Any

from svsa.errors import ParameterError, Violation
from svsa.evaluation.studies.study import Study
from svsa.inputs.toml_file import build_checked, parse_toml, read_checked, read_toml

STUDY_FILE = "study file"
OBJECT = "STUDY"
_BUILT_IN = Path(__file__).parent / "builtin"


def list_built_in() -> dict[str, str]:
    """List the built-in studies: name and title."""
    return {
        path.stem: str(read_toml(path, STUDY_FILE)["title"])
        for path in sorted(_BUILT_IN.glob("*.toml"))
    }


def find_study_file(source: str | Path) -> Path | None:
    """Find a study file: by its name with .toml or .py, or a built-in one by its name."""
    path = Path(source)
    if path.suffix in (".toml", ".py"):
        return path
    return next((file for file in _BUILT_IN.glob("*.toml") if file.stem == str(source)), None)


def read_study(source: str | Path, runs: int | None = None) -> tuple[str, Study]:
    """Read the name and the study of a file, or of a built-in one.

    A Python file defines a `Study` named `STUDY`.

    Args:
        source: File, or name of a built-in study.
        runs: Number of samples, instead of that of the file.

    Returns:
        Name and study.

    Raises:
        ParameterError: If the file cannot be read or a value is invalid, with the file, and the
            lines of a TOML file.
    """
    path = find_study_file(source)
    if path is None:
        known = ", ".join(list_built_in())
        bound = f"a file that ends in .toml or .py, or one of {known}"
        raise ParameterError(Violation("study", str(source), "", bound))
    if path.suffix == ".py":
        study = _run_python(path)
        return path.stem, study if runs is None else study.changed(runs=runs)
    changes: dict[str, Any] = {} if runs is None else {"runs": runs}
    return path.stem, read_checked(Study, path, STUDY_FILE, changes)


def parse_study(text: str, place: str = "", **changes: Any) -> Study:
    """Parse a study in TOML; `changes` replace fields.

    Raises:
        ParameterError: As `read_study`, with `place` as the name of the file.
    """
    return build_checked(Study, parse_toml(text, STUDY_FILE, place), text, place, changes)


def _run_python(path: Path) -> Study:
    try:
        study = runpy.run_path(str(path)).get(OBJECT)
    except ParameterError as error:
        raise ParameterError(*error.violations, file=_find_place(path, error)) from None
    except (Exception, SystemExit) as error:
        place = _find_place(path, error)
        bound = f"a Python file that runs ({type(error).__name__}: {error})"
        raise ParameterError(Violation(STUDY_FILE, path, "", bound), file=place) from None
    if not isinstance(study, Study):
        bound = f"a file that makes a svsa.evaluation.studies Study called {OBJECT}"
        raise ParameterError(Violation(STUDY_FILE, path, "", bound))
    return study


def _find_place(path: Path, error: BaseException) -> str:
    """Find the file, and its last line in the traceback."""
    frames = traceback.extract_tb(error.__traceback__)
    lines = [frame.lineno for frame in frames if Path(frame.filename) == path]
    return f"{path}, line {lines[-1]}" if lines else str(path)

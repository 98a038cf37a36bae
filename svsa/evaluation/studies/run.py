"""A study from Python: run it, or continue it, and read its rows."""

from pathlib import Path
from typing import TYPE_CHECKING

from rich.console import Console

from svsa.errors import ParameterError, Violation
from svsa.evaluation.progress_bar import show_progress
from svsa.evaluation.studies.execution import WORKERS
from svsa.evaluation.studies.execution import run_study as run_stored
from svsa.evaluation.studies.file import read_study
from svsa.evaluation.studies.rows import read_rows
from svsa.evaluation.studies.store import keep_study
from svsa.evaluation.studies.study import Study
from svsa.inputs.checked import check_number
from svsa.inputs.extras import require_extra

if TYPE_CHECKING:
    import pandas


def run_study(
    source: Study | Path | str,
    *,
    name: str | None = None,
    runs: int | None = None,
    workers: int = WORKERS,
) -> "pandas.DataFrame":
    """Run a study and return a row of settings and metrics for each run.

    An interrupted study of the same name continues. At Ctrl-C the finished rows are saved and
    returned.

    Args:
        source: File (.toml or .py), name of a built-in study, or a `Study`.
        name: Name of the study in the folder of studies; by default that of the file.
        runs: Number of samples, instead of that of the file.
        workers: Number of processes; 0 for this one. On platforms that spawn processes, the calling
            script needs `if __name__ == "__main__":`.

    Returns:
        A frame with a column for each setting that varies, the law, the outcome and each metric, in
        SI units.

    Raises:
        ParameterError: If a file cannot be read, a value is invalid, or a `Study` has no name.
        StudyError: If another study has the name, or another process runs it.
        MissingExtraError: If pandas, of the extra of that name, is not installed.
    """
    require_extra("pandas")
    check_number("workers", workers, "", 0, 256)
    if isinstance(source, Study):
        if name is None:
            raise ParameterError(Violation("name", None, "", "given with a `Study`"))
        known, study = name, source if runs is None else source.changed(runs=runs)
    else:
        known, study = read_study(source, runs)
    stored = keep_study(name or known, study)
    with show_progress(Console(stderr=True), stored.name, study.row_count) as report:
        run_stored(stored, workers, progress=lambda done, _: report(done, ""))
    return read_rows(stored).to_pandas()

"""The progress of long work in a pipe."""

import io

from rich.console import Console

from svsa.evaluation import progress_bar
from svsa.evaluation.progress_bar import show_progress


def test_pipe_receives_lines_with_count_and_total(monkeypatch):
    monkeypatch.setattr(progress_bar, "LINE_S", 0.0)
    pipe = io.StringIO()
    with show_progress(Console(file=pipe), "Practice", 200) as report:
        report(0)
        report(50)
        report(200, "Hidden trials")
    lines = pipe.getvalue().splitlines()
    assert any(line.startswith("Practice: 50 of 200 runs") for line in lines)
    assert any(line.startswith("Hidden trials: 200 of 200 runs") for line in lines)


def test_pipe_receives_no_line_before_the_interval():
    pipe = io.StringIO()
    with show_progress(Console(file=pipe), "Short", 2) as report:
        report(1)
        report(2)
    assert "of 2" not in pipe.getvalue()

"""The page of a worst run: its law, its comparison, and metrics as on the leaderboard."""

import numpy as np
import pytest

from svsa.teaching.leaderboard.board import Board, measure_missing
from svsa_server.runs import worst_run_page
from svsa_server.runs.worst_run_page import build_worst_run_page
from tests.teaching.leaderboard.test_leaderboard import short_season  # noqa: F401


@pytest.mark.usefixtures("short_season")
def test_page_shows_the_run_of_the_board_next_to_ndobc(tmp_path, monkeypatch):
    board, given = Board(tmp_path), []
    measure_missing(board)
    entry = board.get("fl")

    def note(*positional, **named):
        given.append((positional, named))
        return "page"

    monkeypatch.setattr(worst_run_page, "build_replay_html", note)
    assert build_worst_run_page(board, entry) == "page"
    (title, period_s, lanes, channels, samples, mass, details), named = given[0]
    assert title == f"{lanes[0]}: {entry.standing.worst.title}"
    assert lanes[1] == "NDOBC, declared gains"
    assert samples.shape == (11_000, 2, len(channels))
    assert mass.shape == (11_000,)
    assert details["Controller"]["Law"] == lanes[0]
    assert [one.kind for one in named["events"]] == ["load_on"]
    window = named["window"]
    error = samples[window.first_tick : window.end_tick, 0, channels.index("position_error_rad")]
    shown = np.degrees(np.sqrt(np.mean(error**2)))
    assert shown == pytest.approx(entry.standing.worst.rms_deg)
    assert window.start_s == pytest.approx(window.first_tick * period_s)
    secret = (board.folder / "secret").read_bytes()
    assert secret.hex() not in repr(details)

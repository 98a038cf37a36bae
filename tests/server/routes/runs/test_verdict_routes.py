"""One recorded run compared with another over REST."""

from pathlib import Path

import httpx
import numpy as np
import pytest

from svsa.runs.definition.design import Lane
from svsa.runs.definition.paper import get_figure
from svsa.runs.records.catalogue.runs import Catalogue
from svsa.runs.records.writer import write_record
from svsa.simulation.plant.loads.mass import MassLoad
from tests.runs.records.records import build_header, build_samples
from tests.server.routes.runs.conftest import FIRST_TICK, POSITION, TICKS


def test_run_is_compared_with_another_with_the_band_to_draw(client: httpx.Client) -> None:
    """The runs of this lab have equal samples, except one sample of one run."""
    wanted = {"other": "run-1", "rest": None, "points": 500}
    wanted["tolerances"] = {"position_rad": {"absolute": 0.5, "time_s": 0.01}}
    reported = client.post("runs/run-0/verdict", json=wanted).raise_for_status().json()
    assert (reported["held"], reported["ticks"]) == (True, TICKS)
    assert [one["lane"] for one in reported["channels"]] == ["ndobc", "fl"]
    band = reported["bands"]["position_rad"]["fl"]
    assert len(band["time_s"]) == len(band["low"]) == len(band["high"]) <= 500
    assert max(band["high"]) == 1e6 + 0.5
    assert None not in band["low"]
    given = {"other": "none"}
    assert client.post("runs/run-0/verdict", json=given).status_code == 404
    wrong = wanted | {"tolerances": {"speed": {}}}
    refused = client.post("runs/run-0/verdict", json=wrong)
    assert refused.status_code == 422
    assert "a channel of both runs" in refused.json()["detail"]
    negative = wanted | {"tolerances": {"position_rad": {"absolute": -1}}}
    assert "absolute" in client.post("runs/run-0/verdict", json=negative).json()["detail"]


def test_runs_are_compared_from_the_start_of_their_windows(
    client: httpx.Client, catalogue: Catalogue, data: Path
) -> None:
    """A load 150 ticks later, and a step of the position as much later."""
    for run_id, tick in (("early", 1200), ("late", 1350)):
        samples = build_samples(TICKS, first_tick=FIRST_TICK)
        samples[:, :, POSITION] = (np.arange(TICKS) >= tick - FIRST_TICK)[:, None]
        settings = (
            get_figure("4a").build_configuration(load=False).changed(comparisons=(Lane(law="fl"),))
        )
        header = build_header(run_id, configuration=settings.model_dump(mode="json"))
        mass = MassLoad(mass_kg=3.0).model_dump(mode="json")
        commands = [(tick, {"tick": tick, "kind": "load", "argument": mass})]
        write_record(data / "runs" / run_id, header, commands, FIRST_TICK, samples)
        catalogue.register(header)
        catalogue.finish(run_id)
    wanted = {"other": "early", "rest": None, "tolerances": {"position_rad": {}}}
    reported = {
        align: client.post("runs/late/verdict", json=wanted | {"align": align}).json()
        for align in ("start", "window")
    }
    first, _ = reported["start"]["channels"]
    period = build_header("x").period_s
    assert first["outside_s"] == pytest.approx(150 * period)
    assert first["outside"] == [[pytest.approx(1200 * period), pytest.approx(1349 * period)]]
    assert [one["held"] for one in reported["window"]["channels"]] == [True, True]
    assert reported["window"]["begin_s"] - reported["window"]["other_begin_s"] == pytest.approx(
        150 * period
    )
    assert not reported["window"]["held"]  # shorter from there on

"""The list of runs: named, searched, filtered and sorted by its visible fields."""

import sqlite3
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest

from svsa.runs.definition.design import Lane
from svsa.runs.definition.paper import get_figure
from svsa.runs.records.catalogue.database import build_order
from svsa.runs.records.catalogue.entry import SORTS
from svsa.runs.records.catalogue.runs import Catalogue
from svsa.runs.records.header import BranchPoint, read_header, write_header
from svsa.simulation.plant.loads.paper import PaperLoad
from svsa_server.sessions.indexing import Indexing
from svsa_server.sessions.recording import open_catalogue
from tests.runs.records.records import Command, add, list_ids
from tests.waiting import wait_until

OLDER = """
DROP TABLE runs; DROP TABLE facets;
CREATE TABLE runs (
    id TEXT PRIMARY KEY, created TEXT, name TEXT, session TEXT, duration_s REAL,
    bytes INTEGER, state TEXT, trash INTEGER, search TEXT
);
CREATE TABLE tags (tag TEXT, run TEXT, trash INTEGER, PRIMARY KEY (tag, run)) WITHOUT ROWID;
INSERT INTO runs SELECT id, '', '', '', 0, 0, 'complete', 0, '' FROM entries;
UPDATE entries SET entry =
    json_remove(entry, '$.settings', '$.branch_of', '$.window', '$.fault', '$.files');
PRAGMA user_version = 1;
"""

FORMAT_2 = """
UPDATE entries SET entry = json_remove(
    json_set(entry, '$.metrics[0].peak_position_error_rad', 9.0),
    '$.window', '$.fault', '$.files', '$.metrics[0].steady_state_position_error_rad'
);
PRAGMA user_version = 2;
"""

FORMAT_4 = """
UPDATE entries SET entry = replace(entry, '"effects":', '"realism":');
PRAGMA user_version = 4;
"""

FORMAT_5 = """
UPDATE entries SET entry = json_remove(entry, '$.metrics[0].work_j');
PRAGMA user_version = 5;
"""


def add_figure(
    catalogue: Catalogue,
    run_id: str,
    figure: str = "4a",
    name: str = "",
    load: bool = False,
    commands: Sequence[Command] = (),
    branch_of: BranchPoint | None = None,
    tags: tuple[str, ...] = (),
    **changes: Any,
) -> None:
    """Add a run of 0.02 s with the settings of a figure of the paper."""
    loads = (PaperLoad(),) if load else ()
    configuration = get_figure(figure).build_configuration().changed(loads=loads, **changes)
    add(
        catalogue,
        run_id,
        lanes=tuple(f"lane{number + 1}" for number in range(len(configuration.lanes))),
        configuration=configuration.model_dump(mode="json"),
        commands=commands,
        branch_of=branch_of,
        name=name,
        tags=tags,
        notes="",
    )


@pytest.fixture
def varied(catalogue: Catalogue) -> Catalogue:
    """run-1 … run-4, of which only the last was named by a user."""
    add_figure(catalogue, "run-1", "4b", comparisons=(Lane(law="fl"),), load=True)
    add_figure(catalogue, "run-2", "4a", law="fl")
    changed = [(10, {"tick": 10, "kind": "law", "argument": "fl"})]
    add_figure(catalogue, "run-3", "5", commands=changed)
    add_figure(catalogue, "run-4", "4a", name="Mine", tags=("class",))
    return catalogue


def test_run_is_named_by_its_settings_until_a_user_names_it(varied: Catalogue) -> None:
    titles = {run.id: run.title for run in varied.list().runs}
    assert titles == {
        "run-1": "Fig. 4B motion · NDOBC vs FL · σ 60 · 3 kg",
        "run-2": "Fig. 4A motion · FL · σ 15 · no load",
        "run-3": "Fig. 5 motion · NDOBC → FL · σ 35 ± 1 · no load",
        "run-4": "Mine",
    }
    assert varied.update("run-2", name="Named").title == "Named"
    assert varied.update("run-2", name="").title == titles["run-2"]


def test_search_finds_visible_text_only(catalogue: Catalogue) -> None:
    for number in (5, 7, 17, 21):
        run_id = f"20260107-0{number:02}707-07{number:04}"
        add_figure(catalogue, run_id, "5", name=f"Student {number:02}")
    assert [run.name for run in catalogue.list("Student 07").runs] == ["Student 07"]
    found = catalogue.list("sTUDENT 7", sort="name").runs
    assert [run.name for run in found] == ["Student 07", "Student 17"]
    assert catalogue.list("20260107").total == 0
    assert list_ids(catalogue, search="20260107-005707-070005") == ["20260107-005707-070005"]


@pytest.mark.parametrize("word", ["%", "_", "*", "Stud%", "Student_07", '"', "'", "NEAR", "\\"])
def test_operators_of_the_query_language_are_literal(catalogue: Catalogue, word: str) -> None:
    add_figure(catalogue, "run-1", name="Student 07")
    add_figure(catalogue, "run-2", name=f"a{word}b")
    assert list_ids(catalogue, search=word) == ["run-2"]


def test_settings_tags_and_accents_are_found(varied: Catalogue) -> None:
    add_figure(varied, "run-5", name="U\u0308bung")
    assert list_ids(varied, search="übung") == ["run-5"]
    assert list_ids(varied, search="σ 60") == ["run-1"]
    assert list_ids(varied, search="fig. 4b 3 KG") == ["run-1"]
    assert list_ids(varied, search="→ fl") == ["run-3"]
    assert list_ids(varied, search="class") == ["run-4"]
    assert list_ids(varied, search="mine fig.") == ["run-4"]


@pytest.mark.parametrize(
    ("filters", "expected"),
    [
        ({"law": "fl"}, ["run-1", "run-2", "run-3"]),
        ({"law": "ndobc"}, ["run-1", "run-3", "run-4"]),
        ({"load": "paper"}, ["run-1"]),
        ({"load": "none", "law": "fl"}, ["run-2", "run-3"]),
        ({"figure": "4a"}, ["run-2", "run-4"]),
        ({"figure": "4a", "tag": "class"}, ["run-4"]),
        ({"plant": "bench"}, []),
    ],
)
def test_filters_select_the_matching_runs(
    varied: Catalogue, filters: dict, expected: list[str]
) -> None:
    assert sorted(list_ids(varied, **filters)) == expected
    assert varied.list(**filters).total == len(expected)


def test_facets_list_the_available_filters(varied: Catalogue) -> None:
    varied.delete("run-2")
    assert varied.list_facets() == {
        "tag": {"class": 1},
        "law": {"fl": 2, "ndobc": 3},
        "load": {"none": 2, "paper": 1},
        "figure": {"4a": 1, "4b": 1, "5": 1},
        "plant": {"simulated": 3},
    }


def test_every_column_sorts_with_unknown_values_last(varied: Catalogue) -> None:
    recorder = varied.record(read_header(varied.find_folder("run-4")).changed(run_id="run-9"))
    order = {
        "stiffness_nm_per_rad": ["run-2", "run-4", "run-3", "run-1"],
        "-stiffness_nm_per_rad": ["run-1", "run-3", "run-4", "run-2"],
        "figure": ["run-2", "run-4", "run-1", "run-3"],
        "-laws": ["run-3", "run-1", "run-4", "run-2"],
        "load": ["run-1", "run-2", "run-3", "run-4"],
    }
    for sort, expected in order.items():
        assert list_ids(varied, sort=sort) == [*expected, "run-9"], sort
    recorder.close()


def test_names_sort_naturally(catalogue: Catalogue) -> None:
    for number in (10, 9, 100):
        add_figure(catalogue, f"run-{number}", name=f"group {number}")
    assert list_ids(catalogue, sort="name") == ["run-9", "run-10", "run-100"]


def test_sorting_and_paging_use_an_index(varied: Catalogue) -> None:
    connection = sqlite3.connect(varied.folder / "catalogue.sqlite")
    for sort in (f"{sign}{name}" for name in SORTS for sign in ("", "-")):
        order = build_order(sort)
        select = f"SELECT id FROM runs WHERE trash = 0 ORDER BY {order} LIMIT 20"  # noqa: S608
        plan = " ".join(row[3] for row in connection.execute(f"EXPLAIN QUERY PLAN {select}"))
        assert "USING COVERING INDEX" in plan, (sort, plan)
        assert "TEMP B-TREE" not in plan, (sort, plan)
    connection.close()


def test_branch_shows_the_current_name_of_its_origin(catalogue: Catalogue) -> None:
    add_figure(catalogue, "run-1", name="First")
    add_figure(catalogue, "run-2", name="Second", branch_of=BranchPoint("run-1", 12))
    assert catalogue.get("run-2").branch_of == BranchPoint("run-1", 12)
    assert list_ids(catalogue, search="second first") == ["run-2"]
    catalogue.update("run-1", name="Renamed")
    assert list_ids(catalogue, search="second renamed") == ["run-2"]
    assert list_ids(catalogue, search="first") == []
    catalogue.delete("run-1")
    catalogue.purge("run-1")
    assert list_ids(catalogue, search="run-1 second") == ["run-2"]


def make_older(folder: Path) -> None:
    """The catalogue in the format of the previous version, without settings."""
    connection = sqlite3.connect(folder / "catalogue.sqlite")
    connection.executescript(OLDER)
    connection.close()


def test_catalogue_of_an_older_format_is_opened_and_completed(varied: Catalogue) -> None:
    varied.delete("run-3")
    before = [varied.list(sort="name").runs, varied.list(trash=True).runs]
    make_older(varied.folder)
    again = Catalogue(varied.folder)
    undescribed = again.list(sort="name").runs
    assert {run.settings for run in undescribed} == {None}
    assert [run.title for run in undescribed] == ["Mine", "run-1", "run-2"]
    again.recover()
    assert [again.list(sort="name").runs, again.list(trash=True).runs] == before
    assert list_ids(again, law="ndobc", figure="4b") == ["run-1"]
    assert again.list_facets()["tag"] == {"class": 1}


@pytest.mark.parametrize("former", [FORMAT_2, FORMAT_5], ids=["of whole runs", "fewer"])
def test_metrics_of_an_older_version_are_computed_again(varied: Catalogue, former: str) -> None:
    before = varied.get("run-3")
    assert before.window is not None
    connection = sqlite3.connect(varied.folder / "catalogue.sqlite")
    connection.executescript(former)
    connection.close()
    again = Catalogue(varied.folder)
    assert again.get("run-3").settings == before.settings
    assert again.get("run-3").metrics is None, "a number without its window is not shown"
    again.recover()
    assert again.get("run-3") == before


def test_former_names_are_read(varied: Catalogue) -> None:
    before = varied.get("run-3")
    assert before.metrics is not None
    with sqlite3.connect(varied.folder / "catalogue.sqlite") as connection:
        connection.executescript(FORMAT_4)
    connection.close()
    assert Catalogue(varied.folder).get("run-3") == before


def test_unreadable_run_is_kept_while_others_are_completed(varied: Catalogue) -> None:
    make_older(varied.folder)
    (varied.folder / "runs" / "run-1" / "header.json").write_text("{")
    again = Catalogue(varied.folder)
    again.recover()
    described = {run.id: run.settings is not None for run in again.list().runs}
    assert described == {"run-1": False, "run-2": True, "run-3": True, "run-4": True}


def test_header_of_the_older_format_is_read(varied: Catalogue) -> None:
    folder = varied.find_folder("run-1")
    header = read_header(folder)
    written = header.to_json().replace('"branch_of":null,', "")
    assert written != header.to_json()
    (folder / "header.json").write_text(written)
    assert read_header(folder) == header
    write_header(folder, header)


def test_server_completes_the_entries_of_an_older_one(
    varied: Catalogue, monkeypatch: pytest.MonkeyPatch
) -> None:
    make_older(varied.folder)
    monkeypatch.setenv("SVSA_DATA", str(varied.folder))
    opened = open_catalogue()
    indexing = Indexing(opened)
    wait_until(lambda: indexing.progress is None)
    assert opened.list(figure="4b").total == 1

"""A recorded run as a page of its own."""

import pytest

from svsa.runs.definition.paper import get_figure
from svsa.runs.records.reader import build_record
from svsa_server.runs import replay_export
from tests.runs.records.records import build_header, build_samples


@pytest.mark.parametrize(
    ("name", "title"), [("", "Fig. 4A · NDOBC · σ 15 · 3 kg"), ("Mine", "Mine")]
)
def test_page_is_named_as_in_the_list_of_runs(
    monkeypatch: pytest.MonkeyPatch, name: str, title: str
) -> None:
    configuration = get_figure("4a").build_configuration().model_dump(mode="json")
    header = build_header(lanes=("lane1",), name=name, configuration=configuration)
    record = build_record(header, [], 4_000, build_samples(2_000, 1, 4_000))
    titles: list[str] = []

    def note(given: str, *_: object, **__: object) -> str:
        titles.append(given)
        return ""

    monkeypatch.setattr(replay_export, "build_replay_html", note)
    replay_export.build_replay(record)
    assert titles == [title]

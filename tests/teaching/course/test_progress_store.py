"""Progress of the course on disk: a damaged file is set aside, and loses only what was last."""

import logging
from pathlib import Path

import pytest

from svsa.teaching.course.progress import ExerciseProgress, PersonProgress, ProgressStore


def write_two(folder: Path) -> tuple[ProgressStore, Path]:
    """A store in which a person has gone to a first step, then to a second one."""
    store = ProgressStore(folder)
    for step in ("first", "second"):
        store.write("ada", PersonProgress(exercises={"one": ExerciseProgress(at=step)}))
    return store, folder / "course" / "people" / "ada.json"


@pytest.mark.parametrize("content", [b"", b"{", b"[]", b'{"exercises": {"one": {"at": 7}}}'])
def test_a_damaged_file_is_kept_aside_and_the_version_before_it_is_used(
    tmp_path: Path, content: bytes, caplog: pytest.LogCaptureFixture
) -> None:
    store, path = write_two(tmp_path)
    path.write_bytes(content)
    with caplog.at_level(logging.WARNING, "svsa"):
        assert store.read("ada").get("one").at == "first"
    assert "ada.json is damaged" in caplog.text
    (aside,) = path.parent.glob("ada.json.damaged-*")
    assert aside.read_bytes() == content
    store.write("ada", PersonProgress())
    assert aside.read_bytes() == content, "it is not written over"


def test_a_file_that_was_not_written_to_its_end_leaves_the_version_before(tmp_path: Path) -> None:
    store, path = write_two(tmp_path)
    path.unlink()
    assert store.read("ada").get("one").at == "first"
    assert store.read("bob") == PersonProgress()


def test_a_file_that_cannot_be_read_is_no_empty_progress(tmp_path: Path) -> None:
    store, path = write_two(tmp_path)
    path.unlink()
    path.mkdir()
    with pytest.raises(OSError):
        store.read("ada")

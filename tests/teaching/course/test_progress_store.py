"""Progress of the course on disk: a damaged file is set aside and only the last change is lost."""

import logging
from pathlib import Path

import pytest

from svsa.teaching.course.progress import ExerciseProgress, PersonProgress, ProgressStore


def write_two(folder: Path) -> tuple[ProgressStore, Path]:
    """A store in which a user has reached a first step, then a second one."""
    store = ProgressStore(folder)
    for step in ("first", "second"):
        store.write("ada", PersonProgress(exercises={"one": ExerciseProgress(at=step)}))
    return store, folder / "course" / "people" / "ada.json"


@pytest.mark.parametrize("content", [b"", b"{", b"[]", b'{"exercises": {"one": {"at": 7}}}'])
def test_damaged_file_is_set_aside_and_the_previous_version_is_used(
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


def test_interrupted_write_leaves_the_previous_version(tmp_path: Path) -> None:
    store, path = write_two(tmp_path)
    path.unlink()
    assert store.read("ada").get("one").at == "first"
    assert store.read("bob") == PersonProgress()


def test_unreadable_file_is_not_empty_progress(tmp_path: Path) -> None:
    """A fault of the disk, unlike damaged content, may pass: nothing is set aside."""
    store, path = write_two(tmp_path)
    path.parent.rename(tmp_path / "elsewhere")
    path.parent.write_bytes(b"")
    with pytest.raises(OSError):
        store.read("ada")

"""A file of the data folder is read, or rejected at once, whatever it is."""

import os
from collections.abc import Callable
from pathlib import Path

import pytest

from svsa.inputs.stored_file import read_json


@pytest.mark.parametrize(
    "make",
    [
        Path.mkdir,
        os.mkfifo,
        lambda path: path.symlink_to(path),
        lambda path: path.symlink_to("missing"),
        lambda path: path.symlink_to("/dev/zero"),
        lambda path: path.write_bytes(b"\xff{}"),
        lambda path: path.write_text("[" * 5000),
        lambda path: path.write_text(""),
    ],
    ids=["folder", "pipe", "loop", "link", "device", "bytes", "deep", "empty"],
)
def test_what_is_no_json_is_rejected(make: Callable[[Path], object], tmp_path: Path) -> None:
    make(path := tmp_path / "file.json")
    with pytest.raises((OSError, ValueError)):
        read_json(path)


def test_json_is_read(tmp_path: Path) -> None:
    (path := tmp_path / "file.json").write_text('{"a": [1, "\u00e4"]}', encoding="utf-8")
    assert read_json(path) == {"a": [1, "ä"]}

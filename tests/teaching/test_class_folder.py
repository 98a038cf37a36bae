"""The secret of a class or a season: generated once, and again if a full disk left an
empty file.
"""

import stat
from pathlib import Path

import pytest

from svsa.errors import ParameterError
from svsa.inputs.checked import Checked, quantity
from svsa.teaching.class_folder import SECRET_BYTES, ClassFolder, keep_secret


class Points(Checked):
    points: float = quantity("1", "Points")


def test_secret_is_generated_once_and_readable_by_its_account_only(tmp_path: Path) -> None:
    path = tmp_path / "secret"
    secret = keep_secret(path)
    assert len(secret) == SECRET_BYTES
    assert keep_secret(path) == secret
    assert stat.S_IMODE(path.stat().st_mode) == 0o600
    assert [one.name for one in tmp_path.iterdir()] == ["secret"]


def test_empty_secret_is_generated_again_and_another_file_is_rejected(tmp_path: Path) -> None:
    path = tmp_path / "secret"
    path.touch()
    assert len(keep_secret(path)) == SECRET_BYTES
    path.write_bytes(b"short")
    with pytest.raises(ParameterError, match="of 32 bytes"):
        keep_secret(path)


@pytest.mark.parametrize("content", [b"", b"{", b"[]", b"\xff", b'{"points": "x"}', b"[" * 100_000])
def test_damaged_result_leaves_the_others_readable(
    content: bytes, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    folder = ClassFolder(tmp_path, Points, ("grades", "results", "runs"))
    folder.write("whole", Points(points=3.0))
    damaged = tmp_path / "results" / "damaged.json"
    damaged.write_bytes(content)
    assert list(folder.read_all()) == [Points(points=3.0)]
    assert damaged.read_bytes() == content
    assert len(caplog.records) == 1
    assert str(damaged) in caplog.text
    with pytest.raises(ParameterError):
        folder.find("damaged")

"""What of the compiled code goes: what nobody has opened for long, and nothing of anybody else."""

import os
import time
from pathlib import Path

import pytest

from svsa.code_cache import ABANDONED_S, KEPT_TEXTS, UNUSED_S, open_folder

OLD, NEW = f"{1:016x}", f"{2:016x}"


@pytest.fixture
def root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("SVSA_CACHE", str(tmp_path))
    return tmp_path


def make(folder: Path, age_s: float) -> Path:
    folder.mkdir(parents=True)
    (folder / "function.nbc").write_bytes(b"code")
    then = time.time() - age_s
    os.utime(folder, (then, then))
    return folder


def test_code_of_earlier_versions_goes_when_nobody_has_opened_it_for_long(root: Path) -> None:
    gone = [
        make(root / f"compiled-{OLD}", 1.1 * ABANDONED_S),
        make(root / "svsa.runtime.loop" / OLD, 1.1 * ABANDONED_S),
    ]
    kept = [
        make(root / f"compiled-{NEW}", 0.9 * ABANDONED_S),
        make(root / "svsa.runtime.kernel" / OLD, 1.1 * ABANDONED_S),
        make(root / "svsa.runtime.kernel" / NEW, 0.9 * ABANDONED_S),
    ]
    opened = open_folder("svsa.loop.loop", NEW)
    assert opened == root / "svsa.loop.loop" / NEW
    assert opened.is_dir()
    assert [folder.exists() for folder in gone] == [False, False]
    assert all((folder / "function.nbc").exists() for folder in kept)


def test_what_is_not_called_as_its_own_stays(root: Path) -> None:
    others = [
        make(root / "photos" / "summer", 9 * ABANDONED_S),
        make(root / "compiled-by-hand", 9 * ABANDONED_S),
        make(root / "empty.module", 9 * ABANDONED_S),
    ]
    open_folder("svsa.loop.loop", NEW)
    assert all((folder / "function.nbc").exists() for folder in others)


def test_of_a_file_s_texts_the_newest_stay_and_those_in_use(root: Path) -> None:
    module = root / "svsa.loop.loop"
    ages_s = [0.5 * UNUSED_S, 0.9 * UNUSED_S, 1.1 * UNUSED_S, 5.0 * UNUSED_S]
    texts = [make(module / f"{number:016x}", age) for number, age in enumerate(ages_s)]
    in_use = [make(module / f"{number + 8:016x}", 60.0 * number) for number in range(KEPT_TEXTS)]
    open_folder("svsa.loop.loop", f"{99:016x}")
    assert [text.exists() for text in texts] == [True, True, False, False]
    assert all(text.exists() for text in in_use)

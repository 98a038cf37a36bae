"""Any damage of the folder of compiled code costs one compilation and at most one line."""

import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numba
import pytest
from numba.core import config

from svsa.actuators import energy
from svsa.actuators.installed import get_mechanism
from svsa.numerics import cache_folder, code_cache
from svsa.numerics.cache_folder import choose_root, open_folder
from svsa.numerics.code_cache import SharedCache
from tests.exhaustive import exhaust

MODULE, FINGERPRINT = "svsa.numerics.trigonometry", f"{7:016x}"
TYPES = (numba.float64,)


def add_one(x: float) -> float:
    return x + 1.0


def add_two(x: float) -> float:
    return x + 2.0


CODE = {function: numba.njit(TYPES)(function) for function in (add_one, add_two)}


@pytest.fixture
def root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    root = tmp_path / "cache"
    monkeypatch.setenv("SVSA_CACHE", str(root))
    return root


@pytest.fixture(autouse=True)
def start(monkeypatch: pytest.MonkeyPatch) -> Callable[[], None]:
    """What a new process begins with: it has not reported anything."""

    def forget() -> None:
        monkeypatch.setattr(cache_folder, "_is_reported", False)
        cache_folder.report.cache_clear()

    forget()
    return forget


def open_cache(monkeypatch: pytest.MonkeyPatch, function: Any = add_one) -> SharedCache:
    monkeypatch.setattr(config, "CACHE_DIR", str(open_folder(MODULE, FINGERPRINT)))
    return SharedCache(function)


def load(cache: SharedCache, function: Any = add_one) -> Any:
    return cache.load_overload(TYPES, CODE[function].targetctx)


def save(cache: SharedCache, function: Any = add_one) -> None:
    cache.save_overload(TYPES, CODE[function].overloads[TYPES])


def change(edit: Callable[[bytes], bytes]) -> Callable[[Path], object]:
    return lambda path: path.write_bytes(edit(path.read_bytes()))


def become(make: Callable[[Path], object]) -> Callable[[Path], object]:
    return lambda path: (path.unlink(), make(path))


def flip(content: bytes) -> bytes:
    middle = len(content) // 2
    return content[:middle] + bytes([content[middle] ^ 1]) + content[middle + 1 :]


DAMAGES = {
    **{f"cut at {part} of 8": change(lambda content, part=part: content[: len(content) * part // 8])
       for part in range(8)},
    "without its last byte": change(lambda content: content[:-1]),
    "one bit": change(flip),
    "random": change(lambda content: bytes(range(256)) * 20),
    "foreign class": change(lambda content: b"cno_such_module\nNothing\n."),
    "other version": lambda path: code_cache.write_sealed(path, b"cno_such_module\nNothing\n."),
    "folder": become(lambda path: (path / "x").mkdir(parents=True)),
    "pipe": become(os.mkfifo),
    "circle": become(lambda path: path.symlink_to(path.name)),
    "dangling": become(lambda path: path.symlink_to("missing/file")),
}  # fmt: skip


@pytest.mark.parametrize("damage", DAMAGES.values(), ids=DAMAGES)
@pytest.mark.parametrize("ending", ["nbi", "nbc"])
def test_damaged_file_is_compiled_again_once(
    root: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture,
    damage: Callable[[Path], object], ending: str,
) -> None:  # fmt: skip
    for function in (add_one, add_two):
        save(open_cache(monkeypatch, function), function)
        assert load(open_cache(monkeypatch, function), function)
    files = [*root.rglob(f"*.{ending}")]
    assert len(files) == 2
    for path in files:
        damage(path)
    for function in (add_one, add_two):
        assert load(open_cache(monkeypatch, function), function) is None
        save(open_cache(monkeypatch, function), function)
        assert load(open_cache(monkeypatch, function), function).signature.args == TYPES
    (message,) = caplog.messages
    assert str(root) in message


@pytest.mark.exhaustive
@pytest.mark.parametrize("ending", ["nbi", "nbc"])
def test_file_cut_at_any_byte_is_not_read(
    root: Path, monkeypatch: pytest.MonkeyPatch, ending: str
) -> None:
    save(open_cache(monkeypatch))
    (path,) = root.rglob(f"*.{ending}")
    content = path.read_bytes()
    for length in range(len(content)):
        path.write_bytes(content[:length])
        assert load(open_cache(monkeypatch)) is None
    path.write_bytes(content)
    assert load(open_cache(monkeypatch))


def test_code_of_another_function_is_not_run(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for function in (add_one, add_two):
        save(open_cache(monkeypatch, function), function)
    first, second = sorted(root.rglob("*.nbc"))
    shutil.copy(second, first)
    assert load(open_cache(monkeypatch)) is None


@pytest.mark.parametrize("make", [Path.touch, lambda path: path.symlink_to(path.name),
                                  lambda path: path.symlink_to("missing"), os.mkfifo],
                         ids=["file", "circle", "dangling", "pipe"])  # fmt: skip
@pytest.mark.parametrize("depth", [1, 2, 3])
def test_what_is_in_place_of_a_folder_is_replaced(
    root: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture,
    make: Callable[[Path], object], depth: int,
) -> None:  # fmt: skip
    save(open_cache(monkeypatch))
    (file,) = root.rglob("*.nbc")
    path = root.joinpath(*file.relative_to(root).parts[:depth])
    shutil.rmtree(path)
    make(path)
    assert load(open_cache(monkeypatch)) is None
    save(open_cache(monkeypatch))
    assert load(open_cache(monkeypatch))
    (message,) = caplog.messages
    assert str(root) in message


def test_full_disk_costs_the_storage_only(
    root: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    """The index of other types must not name code that could not be written."""
    resource, signal = pytest.importorskip("resource"), pytest.importorskip("signal")
    cache = open_cache(monkeypatch)
    before, limits = signal.signal(signal.SIGXFSZ, signal.SIG_IGN), resource.RLIMIT_FSIZE
    bound = resource.getrlimit(limits)
    resource.setrlimit(limits, (1000, bound[1]))
    try:
        save(cache)
    finally:
        resource.setrlimit(limits, bound)
        signal.signal(signal.SIGXFSZ, before)
    assert load(cache) is None
    assert not [path for path in root.rglob("*") if path.is_file()]
    (message,) = caplog.messages
    assert str(root) in message
    save(cache)
    assert load(cache)


def test_root_that_is_a_file_is_kept_and_named(
    root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    root.write_text("mine")
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    save(open_cache(monkeypatch))
    assert load(open_cache(monkeypatch))
    assert root.read_text() == "mine"
    (message,) = caplog.messages
    assert str(root) in message
    other = choose_root()
    assert other is not None
    other.chmod(0o777)
    assert choose_root() is None, "other accounts could write code there"
    assert open_folder(MODULE, FINGERPRINT) is None


def test_home_in_the_path_of_the_cache_is_expanded(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("SVSA_CACHE", "~/compiled")
    assert choose_root() == tmp_path / "compiled"


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() != 0, reason="only root can do it")
@pytest.mark.parametrize("home", exhaust(["", "/proc/none", "{forbidden}"], [""]))
def test_user_without_name_or_home_stores_code_among_temporary_files(
    tmp_path: Path, home: str
) -> None:
    (tmp_path / "forbidden").mkdir(mode=0o700)
    public = Path(f"/tmp/{tmp_path.parent.name}-{tmp_path.name}")  # noqa: S108 (open to all)
    public.mkdir(mode=0o777)
    public.chmod(0o777)
    # Imported as root, who may be the only one to read the interpreter.
    code = (
        "import os, pwd, svsa.numerics.cache_folder as cache; os.environ.pop('HOME');"
        f"os.environ.update({{'HOME': {home!r}}} if {home!r} else {{}});"
        "os.setuid(54321); print(cache.choose_root())"
    ).replace("{forbidden}", str(tmp_path / "forbidden"))
    environment = os.environ | {"TMPDIR": str(public), "SVSA_CACHE": "", "HOME": "/"}
    try:
        ran = subprocess.run(
            [sys.executable, "-c", code], env=environment, capture_output=True, text=True
        )
    finally:
        shutil.rmtree(public)
    assert ran.stdout.strip() == str(public / "svsa-54321"), ran.stderr
    assert len(ran.stderr.splitlines()) == 1


@pytest.mark.parametrize("name", ["cut at 0 of 8", "one bit", "folder", "dangling"])
def test_damaged_text_of_an_energy_is_written_again(
    root: Path, name: str, caplog: pytest.LogCaptureFixture
) -> None:
    mechanism = get_mechanism("sea")
    energy._load_module(mechanism)
    (path,) = (root / "energies").iterdir()
    content = path.read_bytes()
    DAMAGES[name](path)
    energy._load_module(mechanism)
    assert path.read_bytes() == content
    assert len(caplog.messages) == 1


@pytest.mark.exhaustive
def test_truncated_file_in_a_command_is_not_only_aborted() -> None:
    code = (
        "import sys; from svsa import cli\n"
        "def end(): raise EOFError('ran out of input')\n"
        "cli.app.command('end')(end); sys.argv = ['svsa', 'end']; cli.main()"
    )
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert ran.returncode == 1
    assert "ran out of input" in ran.stderr
    assert "Aborted" not in ran.stderr

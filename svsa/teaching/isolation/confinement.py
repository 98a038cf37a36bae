"""Confinement of a law by bubblewrap: namespaces that contain an interpreter only.

The law has its own user, process, mount, network, IPC, host name and control group namespaces.
Mounted read-only are the interpreter with its library, the system's shared libraries, numpy, the
model's equations and the law. It can write to one empty folder of a megabyte and `FOLDER_NAMES`
names. There is no /proc, no /dev, and no environment.
"""

import shutil
import sys
import sysconfig
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

import numpy as np

from svsa.teaching.isolation.refusal import NotIsolatedError
from svsa.teaching.isolation.system_calls import compile_filter

FOLDER_BYTES = 1 << 20
FOLDER_NAMES = 100
"""Files and folders that a law may have in its folder. Each takes memory of the kernel, which no
limit of a process includes."""
_HERE = Path(__file__).parent
_LIBRARY = _HERE.parents[1]
_CHILD = (_HERE / "child.py", _HERE / "frames.py", _LIBRARY / "control" / "plain_law.py")
_EQUATIONS = ("actuators", "numerics/trigonometry.py", "numerics/exponential.py")
_SYSTEM_LIBRARIES = ("/lib", "/lib32", "/lib64", "/usr/lib", "/usr/lib64")
_OTHERS_PACKAGES = ("site-packages", "dist-packages")


class Bounds(NamedTuple):
    """Resource limits of a law.

    Attributes:
        memory_bytes: Memory, bytes.
        cpu_s: Processor time, whole seconds.
        output_bytes: Size of the output, and of any file, bytes.
        start_s: Time for loading, s.
        answer_s: Wall-clock time of one answer, s.
        whole_s: Wall-clock time of a whole run, s.
    """

    memory_bytes: int = 1 << 30
    cpu_s: int = 60
    output_bytes: int = 1 << 16
    start_s: float = 20.0
    answer_s: float = 2.0
    whole_s: float = 120.0


BOUNDS = Bounds()


class Command(NamedTuple):
    """The command that starts the law's process, and its working folder."""

    words: Sequence[str]
    folder: str = "/"


def check_tools() -> str:
    """Return the path of bwrap.

    Raises:
        NotIsolatedError: If a tool is missing.
    """
    if sys.platform != "linux":
        raise NotIsolatedError(f"it runs {sys.platform}")
    path = shutil.which("bwrap")
    if path is None:
        raise NotIsolatedError("bwrap is not installed")
    compile_filter()
    return path


@contextmanager
def confine(source: bytes, answers: int, bounds: Bounds) -> Iterator[Command]:
    """Build the command of a fully isolated law; a context manager that owns the law's files.

    Raises:
        NotIsolatedError: If this machine cannot isolate a law.
    """
    bwrap = check_tools()
    with ExitStack() as opened:
        folder = opened.enter_context(TemporaryDirectory(prefix="svsa-law-"))
        files = {"/lab/law.py": source, "/lab/filter": compile_filter()}
        mounts: list[str] = []
        for target, text in files.items():
            path = Path(folder) / Path(target).name
            path.write_bytes(text)
            mounts += ["--ro-bind", str(path), target]
        for path in _CHILD:
            mounts += ["--ro-bind", str(path), f"/lab/{path.name}"]
        for name in _EQUATIONS:
            mounts += ["--ro-bind", str(_LIBRARY / name), f"/lab/svsa/{name}"]
        for path in _list_packages():
            mounts += ["--ro-bind", str(path), f"/lab/packages/{path.name}"]
        words = (
            bwrap, "--unshare-all", "--unshare-user", "--die-with-parent",
            "--new-session", "--clearenv", "--hostname", "lab", "--cap-drop", "ALL",
            # bwrap cannot limit the names in a folder. `child` does it, drops this capability, and
            # reads the law only then; the filter forbids new user namespaces.
            "--cap-add", "CAP_SYS_ADMIN",
            *_mount_interpreter(), *mounts,
            "--size", str(FOLDER_BYTES), "--tmpfs", "/work", "--chdir", "/work",
            "--remount-ro", "/",
            # The filter forbids threads, and OpenBLAS starts some when numpy is imported.
            "--setenv", "OPENBLAS_NUM_THREADS", "1", "--setenv", "PYTHONHASHSEED", "0",
            *_start_child("/lab", "/lab/filter", answers, bounds, FOLDER_NAMES),
        )  # fmt: skip
        yield Command(words)


@contextmanager
def leave_open(source: bytes, answers: int, bounds: Bounds) -> Iterator[Command]:
    """Build the command of a trusted law, with limits of memory and time only."""
    with TemporaryDirectory(prefix="svsa-law-") as folder:
        here = Path(folder)
        (here / "law.py").write_bytes(source)
        for path in _CHILD:
            shutil.copy(path, here)
        (here / "svsa" / "numerics").mkdir(parents=True)
        for name in _EQUATIONS:
            (here / "svsa" / name).symlink_to(_LIBRARY / name)
        (here / "packages").mkdir()
        for path in _list_packages():
            (here / "packages" / path.name).symlink_to(path)
        (here / "work").mkdir()
        yield Command(_start_child(folder, "-", answers, bounds, 0), str(here / "work"))


def _start_child(folder: str, program: str, answers: int, bounds: Bounds, names: int) -> list[str]:
    numbers = (answers, names, bounds.memory_bytes, bounds.cpu_s, bounds.output_bytes)
    # -u: the output of a law is kept even if it is killed.
    interpreter = [str(_find_interpreter()), "-I", "-S", "-B", "-u", f"{folder}/child.py"]
    return [*interpreter, f"{folder}/law.py", program, *map(str, numbers)]


def _find_interpreter() -> Path:
    """Find the interpreter outside the virtual environment."""
    return Path(getattr(sys, "_base_executable", None) or sys.executable).resolve()


def _mount_interpreter() -> list[str]:
    """Mount the interpreter, its library and the system's, without installed packages."""
    library = Path(sys.base_prefix) / "lib"
    standard = Path(sysconfig.get_path("stdlib"))
    paths = dict.fromkeys((*_SYSTEM_LIBRARIES, str(library), str(standard)))
    mounts = [word for path in paths for word in ("--ro-bind-try", path, path)]
    mounts += ["--ro-bind", str(_find_interpreter()), str(_find_interpreter())]
    for parent in dict.fromkeys((standard, library, Path("/usr/lib/python3"))):
        for name in _OTHERS_PACKAGES:
            if (parent / name).is_dir():
                mounts += ["--tmpfs", str(parent / name), "--remount-ro", str(parent / name)]
    return mounts


def _list_packages() -> list[Path]:
    """List the folders of numpy and of the libraries that it needs."""
    numpy = Path(np.__file__).parent
    libraries = numpy.with_name("numpy.libs")
    return [numpy, libraries] if libraries.is_dir() else [numpy]

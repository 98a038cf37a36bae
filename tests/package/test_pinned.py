"""Everything that a build downloads is pinned: images, actions and tools."""

import re
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
DIGEST = re.compile(r"[\w./-]+:[\w.-]+@sha256:[0-9a-f]{64}")
ACTION = re.compile(r"[\w/-]+@[0-9a-f]{40} # v\d+\.\d+\.\d+")


def read_values(files: list[Path], pattern: str) -> Iterator[tuple[str, str]]:
    for file in files:
        for value in re.findall(pattern, file.read_text(encoding="utf-8"), re.MULTILINE):
            yield file.name, value.strip()


def test_images_are_pinned_by_digest() -> None:
    images = [*read_values([*ROOT.glob("docs/deploy/*.yaml")], r"^ +image: (.*)$")]
    built = [("lab.yaml", "svsa-lab")]
    assert [one for one in images if one not in built and not DIGEST.fullmatch(one[1])] == []
    text = (ROOT / "Dockerfile").read_text(encoding="utf-8")
    (base,) = re.findall(r"^ARG BASE_IMAGE=(.*)$", text, re.MULTILINE)
    assert DIGEST.fullmatch(base)
    assert {*re.findall(r"^FROM (\S+)", text, re.MULTILINE)} == {"${BASE_IMAGE}"}


def test_actions_are_pinned_by_commit_with_their_version() -> None:
    actions = [*read_values([*ROOT.glob(".github/workflows/*.yml")], r"uses: (.*)$")]
    assert actions
    assert [one for one in actions if not ACTION.fullmatch(one[1])] == []


@pytest.mark.parametrize("name", ["Makefile", "Dockerfile", ".ci/run", ".ci/package"])
def test_tools_are_pinned_by_version(name: str) -> None:
    """`pip` installs packages with a version only; all others come from the lock file."""
    text = (ROOT / name).read_text(encoding="utf-8").replace("\\\n", " ")
    for command in re.findall(r"bin/pip install (.*)", text):
        packages = [word for word in command.split() if not word.startswith("-")]
        assert packages, command
        assert all(re.fullmatch(r"[\w-]+==(\d[\d.]+|\$\(\w+\))", one) for one in packages), command


def test_image_and_makefile_install_the_same_uv() -> None:
    (made,) = re.findall(r"^UV := (\S+)$", (ROOT / "Makefile").read_text(), re.MULTILINE)
    (copied,) = re.findall(r"\buv==([\d.]+)", (ROOT / "Dockerfile").read_text())
    assert made == copied

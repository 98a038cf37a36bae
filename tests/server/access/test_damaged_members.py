"""Damaged files of members and of links to platforms: one reason, and nothing is destroyed."""

import shutil
from pathlib import Path

import numpy as np
import pytest

from svsa.errors import SecurityError
from svsa_server.access.memberships import FILE as MEMBERS
from svsa_server.access.memberships import Membership, Memberships
from svsa_server.access.roles import Person, Role
from svsa_server.lti.links import FILE as LINKS
from svsa_server.lti.links import Link, Links

SEEDS = range(60)
JOURNAL = b"\xd9\xd5\x05\xf9\x20\xa1\x63\xd7\xff\xff\xff\xff" + bytes(500)
"""The beginning of a journal of SQLite."""


def damage(path: Path, seed: int) -> bytes:
    """Flip a few bits, cut the file, or write random bytes over a part of it."""
    chance, content = np.random.default_rng(seed), bytearray(path.read_bytes())
    place = int(chance.integers(len(content)))
    if seed % 4 == 0:
        del content[place:]
    elif seed % 4 == 1:
        content[place : place + 64] = chance.bytes(64)
    else:
        # In the last page, where the rows are: most damages elsewhere are found by SQLite.
        for _ in range(3):
            content[-1 - int(chance.integers(300))] ^= 1 << int(chance.integers(8))
    path.write_bytes(content)
    return bytes(content)


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("class")
    members, links = Memberships(folder / MEMBERS), Links(folder)
    for number in range(20):
        person = Person(f"p-{number}", f"Ada {number}", Role.OPERATOR)
        members.keep(Membership(person, return_hash=bytes(16)))
        links.learn(Link(person.id, "4", "issuer", "client", "user", "https://item.test/1"))
    return folder


@pytest.mark.parametrize("seed", SEEDS)
def test_damaged_members_are_read_or_rejected_with_a_reason(
    files: Path, tmp_path: Path, seed: int
) -> None:
    """A class must not be emptied silently: its users would lose their runs and grades."""
    path = Path(shutil.copy(files / MEMBERS, tmp_path))
    content = damage(path, seed)
    try:
        Memberships(path)
    except SecurityError as error:
        assert str(path) in str(error)
        assert path.read_bytes() == content


@pytest.mark.parametrize("seed", SEEDS)
def test_damaged_links_are_read_or_set_aside(files: Path, tmp_path: Path, seed: int) -> None:
    path = Path(shutil.copy(files / LINKS, tmp_path))
    content = damage(path, seed)
    journal = tmp_path / f"{LINKS}-journal"
    if seed % 5 == 0:  # of a process that was killed: applied to a new file, it would damage this
        journal.write_bytes(JOURNAL + (files / LINKS).read_bytes()[: 100 * seed])
    links = Links(tmp_path)
    if aside := list(tmp_path.glob("*.damaged-*")):
        assert aside[0].read_bytes() == content
        assert links.list() == []
    link = Link("p-new", "4", "issuer", "client", "user", "https://item.test/2")
    links.learn(link)
    assert link in links.list()

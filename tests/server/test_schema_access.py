"""The API schema with a secret and in a class: every check, in each role."""

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import httpx
import pytest
import schemathesis
from hypothesis import settings
from schemathesis import GenerationMode

from svsa_server.access.class_keys import ClassKeys
from svsa_server.access.memberships import FILE, Membership, Memberships
from svsa_server.access.roles import INSTRUCTOR, Person, Role
from svsa_server.app import build_app
from tests.lab import Lab, run_lab
from tests.server.test_schema_fuzz import SETTINGS, probe

SECRET = "correct horse battery"
ONE_EACH = settings(SETTINGS, max_examples=1)
"""Limits of each operation are tested where no login is needed."""
ENDLESS = dict.fromkeys(
    ("joins", "codes", "logins", "commands", "sessions", "runs"), "1000000/second"
)
"""For a class: too many simultaneous requests have their own tests."""
PEOPLE = {
    Role.OBSERVER: Person("p-1", "Ola", Role.OBSERVER),
    Role.OPERATOR: Person("p-2", "Ada", Role.OPERATOR),
    Role.INSTRUCTOR: INSTRUCTOR,
}


class Class(NamedTuple):
    """A class as a process, and the tokens of its users."""

    lab: Lab
    tokens: dict[Role, str]

    def come_as(self, role: Role | None) -> Lab:
        """The lab, whose client has this role, or none."""
        headers = {} if role is None else {"Authorization": f"Bearer {self.tokens[role]}"}
        client = httpx.Client(base_url=self.lab.url, headers=headers, timeout=60, trust_env=False)
        return self.lab._replace(client=client)


@pytest.fixture(scope="module")
def classroom(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Class]:
    folder: Path = tmp_path_factory.mktemp("class")
    keys, _ = ClassKeys.open(folder)
    for person in PEOPLE.values():
        Memberships(folder / FILE).keep(Membership(person))
    tokens = {role: keys.sign(person) for role, person in PEOPLE.items()}
    with run_lab("--class", data=str(folder), **ENDLESS) as lab:
        yield Class(lab, tokens)


def read_operations(lab: Lab) -> list[schemathesis.APIOperation]:
    schema = lab.client.get("/openapi.json").raise_for_status().json()
    found = schemathesis.openapi.from_dict(schema).get_all_operations()
    return [one.ok() for one in found]


@pytest.mark.exhaustive
def test_lab_with_a_secret_conforms_to_its_schema_and_rejects_clients_without_it() -> None:
    with run_lab(secret=SECRET) as lab:
        operations = read_operations(lab)
        tried = sum(probe(lab, one, GenerationMode.POSITIVE, ONE_EACH) for one in operations)
    assert tried >= len(operations) > 100


@pytest.mark.exhaustive
@pytest.mark.parametrize(
    "role", [None, *PEOPLE], ids=lambda role: role.word if role else "stranger"
)
def test_class_conforms_to_its_schema_in_every_role(classroom: Class, role: Role | None) -> None:
    lab = classroom.come_as(role)
    permissions = build_app().state.permissions
    tried = 0
    operations = read_operations(classroom.come_as(Role.INSTRUCTOR))
    # Leaving ends the token: last.
    for one in sorted(operations, key=lambda one: one.path.endswith("/leave")):
        needed = permissions.find(one.method.upper(), one.path).permission.role
        is_let_in = needed is None or (role is not None and role >= needed)
        if is_let_in and needed is None and role is not None:
            continue  # as without login
        tried += probe(lab, one, GenerationMode.POSITIVE, ONE_EACH, is_let_in)
    lab.client.close()
    assert tried > 100

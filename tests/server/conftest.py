"""What is so for every test of the server in this process."""

from collections.abc import Iterator

import pytest

from svsa_server.access import class_keys


@pytest.fixture(scope="module", autouse=True)
def quick_codes(request: pytest.FixtureRequest) -> Iterator[None]:
    """A class's codes at a thousandth of their cost, which one pays in every test that joins; at
    the whole one in a module with `WHOLE_COST`, and in every lab that is a process of its own.
    """
    with pytest.MonkeyPatch.context() as patch:
        if not getattr(request.module, "WHOLE_COST", False):
            patch.setitem(class_keys._SCRYPT, "n", 2**4)
        yield

"""A catalogue in its own folder."""

from pathlib import Path

import pytest

from svsa.runs.records.catalogue.runs import Catalogue


@pytest.fixture
def catalogue(tmp_path: Path) -> Catalogue:
    return Catalogue(tmp_path)

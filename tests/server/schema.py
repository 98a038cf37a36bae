"""The schema as it is kept, which `test_docs` holds the server to.

Building it would take 2 s in each process that imports the tests.
"""

import json
from pathlib import Path

SCHEMA = json.loads(
    (Path(__file__).parents[2] / "docs" / "openapi.json").read_text(encoding="utf-8")
)

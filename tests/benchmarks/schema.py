"""Thousands of requests that the schema allows or forbids, and every answer that is not as it says.

`nice python -m tests.benchmarks.schema [examples]`: so many an operation, right ones and wrong
ones.
"""

import argparse
import time

import schemathesis
from hypothesis import settings
from schemathesis import GenerationMode

from tests.lab import run_lab
from tests.server.test_schema_fuzz import SETTINGS, probe

PER_OPERATION = 60


def main() -> int:
    """Try every operation; 1 where an answer was not as the schema says."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("examples", type=int, nargs="?", default=PER_OPERATION)
    examples = settings(SETTINGS, max_examples=parser.parse_args().examples, derandomize=False)
    begin, tried, failed = time.monotonic(), 0, 0
    with run_lab() as lab:
        schema = schemathesis.openapi.from_dict(lab.client.get("/openapi.json").json())
        operations = [found.ok() for found in schema.get_all_operations()]
        for mode in GenerationMode:
            for operation in operations:
                try:
                    tried += probe(lab, operation, mode, examples)
                except BaseExceptionGroup as group:
                    failed += len(group.exceptions)
                    for error in group.exceptions:
                        print(f"{operation.label} ({mode.name.lower()}): {error}\n", flush=True)
                except AssertionError as error:
                    failed += 1
                    print(f"{operation.label} ({mode.name.lower()}): {error}\n", flush=True)
    print(f"{tried} requests in {time.monotonic() - begin:.0f} s, {failed} failures")
    return int(failed > 0)


if __name__ == "__main__":
    raise SystemExit(main())

"""Where chance comes from: a number for a season of the suite, a generator for each draw of it."""

import hashlib
import hmac

import numpy as np

SUITE_VERSION = "1"
"""Changes with all that the score counts, draws, sweeps, scenarios, weights: scores compare within
one."""


def derive_seed(secret: bytes, version: str = SUITE_VERSION) -> int:
    """The seed of a season, 64 bits of HMAC-SHA256(secret, version).

    Whoever does not know the secret cannot tune for the trials; published afterwards, it lets
    anybody compute them again.
    """
    return int.from_bytes(hmac.digest(secret, version.encode(), hashlib.sha256)[:8], "big")


PUBLIC_SEED = derive_seed(b"public")


def start_generator(seed: int, number: int) -> np.random.Generator:
    """The generator of the draw `number` of a season: Philox, its key the seed and the number.

    Draws are the same in whatever order, and however many of them, are made. seed: below 2^64.
    """
    return np.random.Generator(np.random.Philox(key=np.array([seed, number], dtype=np.uint64)))

"""Samples of a study: functions of its seed and the number of the run only.

They do not depend on how runs are grouped, their order, the machine, or a restart.
"""

from typing import Any, NamedTuple

import numpy as np

from svsa.errors import ParameterError
from svsa.evaluation.studies.setting import ACTUATOR, change_settings, read_setting
from svsa.evaluation.studies.study import Study, scale
from svsa.runs.definition.configuration import Configuration

_WORDS = 4
"""Number of 64-bit words that Philox generates per counter."""


class ParameterSamples(NamedTuple):
    """The samples first, first + 1, …

    Attributes:
        first: Number of the first sample.
        seeds: Seed of the sensor noise of each sample.
        values: Sampled values of each variation.
    """

    first: int
    seeds: list[int]
    values: list[list[Any]]

    @property
    def size(self) -> int:
        """Number of samples."""
        return len(self.seeds)


def draw(study: Study, first: int, count: int) -> ParameterSamples:
    """Generate the samples `first` to `first + count − 1` of a study.

    Samples of one grid, and of one set for sensitivity, have the same random numbers: they differ
    only in the varied settings.
    """
    numbers = np.arange(first, first + count)
    samples, cells = numbers // study.cells, numbers % study.cells
    begin, end = int(samples[0]), int(samples[-1]) + 1
    words = _make_words(study, begin, end)
    shares = _make_shares(study, words, begin, end)[:, samples - begin]
    values: list[list[Any]] = []
    stride = 1
    for number, variation in enumerate(study.vary):
        if levels := variation.levels:
            values.append([levels[index] for index in cells // stride % len(levels)])
            stride *= len(levels)
        else:
            is_second = (study.sampling == "sensitivity") & ((cells == 1) | (cells == number + 2))
            values.append(variation.draw(np.where(is_second, *shares[::-1, :, number])))
    return ParameterSamples(first, (words[samples - begin, 0] >> np.uint64(1)).tolist(), values)


def _make_words(study: Study, begin: int, end: int) -> np.ndarray:
    """Compute (samples, words) of 64 bits: per sample a seed and a word for each variation.

    Philox is a function of key and counter: a sample's words do not depend on previous ones.
    """
    blocks = -(-(1 + len(study.vary)) // _WORDS)
    philox = np.random.Philox(key=study.seed, counter=begin * blocks)
    return philox.random_raw((end - begin) * blocks * _WORDS).reshape(end - begin, -1)


def _make_shares(study: Study, words: np.ndarray, begin: int, end: int) -> np.ndarray:
    """Compute (2, samples, variations) from 0 to 1: a sample, and its pair for Sobol indices.

    The pair differs from the sample only if the sampling is `sensitivity`.
    """
    count = len(study.vary)
    if study.sampling == "random" or not count:
        shares = (words[:, 1 : 1 + count] >> np.uint64(11)) * 2.0**-53
        return np.stack([shares, shares])
    pairs = 2 if study.sampling == "sensitivity" else 1
    from scipy.stats import qmc  # imported here: the import is slow

    sequence = qmc.Sobol(pairs * count, rng=np.random.default_rng(study.seed))
    point = sequence.random(1) if begin == 0 else sequence.fast_forward(begin).random(1)
    shares = np.concatenate([point, sequence.random(end - begin - 1)])
    return np.stack([shares[:, :count], shares[:, -count:]])


def build_configurations(
    study: Study, law: str, samples: ParameterSamples
) -> list[Configuration | None]:
    """The runs of these samples under a law; None where the settings do not go together."""
    bases = study.build_bases(law)
    present = {
        name: [read_setting(base, variation.path) for variation in study.vary]
        for name, base in bases.items()
    }
    over = [variation.path for variation in study.vary].index(ACTUATOR) if None not in bases else -1
    built: list[Configuration | None] = []
    for row, seed in enumerate(samples.seeds):
        name = None if over < 0 else samples.values[over][row]
        base = bases[name]
        changes: dict[str, Any] = {
            variation.path: scale(variation, at, values[row])
            for number, (variation, at, values) in enumerate(
                zip(study.vary, present[name], samples.values, strict=True)
            )
            if number != over
        }
        try:
            built.append(change_settings(base, changes).model_copy(update={"seed": seed}))
        except ParameterError:
            built.append(None)
    return built

"""Requests and answers about the leaderboard."""

from collections.abc import Sequence

from pydantic import BaseModel, Field

from svsa.inputs.checked import Checked, Whole, quantity
from svsa.teaching.leaderboard.board import MAX_NAME, Author, Entry, EntryName, rank_entries
from svsa.teaching.submission import LawText
from svsa_server.schemas.evaluation.job import JobState


class LawSubmission(Checked):
    """A law to be measured in the season."""

    name: EntryName = quantity("", "Name of the entry on the leaderboard", max_length=MAX_NAME)
    law: LawText = quantity("", "Text of its Python file, which defines `law` or `build`")
    author: Author = quantity("", "Author; in a class the caller", max_length=MAX_NAME, default="")


class SubmissionState(BaseModel):
    """The state of a submission."""

    key: str = Field(description="Key of its entry: SHA-256 of the file")
    job: JobState | None = Field(
        description="Job that measures it; null if it already has an entry"
    )


class RankedEntry(Entry):
    """An entry with its rank."""

    rank: Whole = quantity(
        "", "Rank by success rate, 1 is the best; equal rates share a rank", ge=1
    )


def describe_entries(entries: Sequence[Entry]) -> list[RankedEntry]:
    """Describe the entries with their ranks."""
    ranks = rank_entries(entries)
    return [RankedEntry(**dict(entry), rank=at) for at, entry in zip(ranks, entries, strict=True)]


class LeaderboardState(BaseModel):
    """A season and its entries, the best first."""

    suite: str = Field(
        description="Version of the trials; results are comparable within one version"
    )
    began: str | None = Field(
        description="When the season began, UTC, ISO 8601; null before its first measurement"
    )
    not_isolated: str | None = Field(
        description="Why this machine cannot isolate a law; null if it can"
    )
    runs: int = Field(description="Number of runs for each law")
    entries: list[RankedEntry]
    missing: list[str] = Field(description="Installed laws without an entry")

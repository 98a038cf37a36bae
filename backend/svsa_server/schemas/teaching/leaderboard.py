"""Requests and answers about the leaderboard."""

from collections.abc import Sequence

from pydantic import BaseModel, Field

from svsa.inputs.checked import Checked, Whole, quantity
from svsa.teaching.leaderboard.board import MAX_NAME, Author, Entry, EntryName, rank_entries
from svsa.teaching.submission import LawText
from svsa_server.schemas.evaluation.job import JobState


class LawSubmission(Checked):
    """A law to be measured in the season."""

    name: EntryName = quantity("", "What it is called on the board", max_length=MAX_NAME)
    law: LawText = quantity("", "Text of its file, Python: see docs/grading.md")
    author: Author = quantity(
        "", "Who submits it; in a class it is the person who asks", max_length=MAX_NAME, default=""
    )


class SubmissionState(BaseModel):
    """The state of a submission."""

    key: str = Field(description="Of its entry: SHA-256 of its text")
    job: JobState | None = Field(description="To be followed; null where it has its entry already")


class RankedEntry(Entry):
    """An entry with its rank."""

    rank: Whole = quantity("", "By success rate, 1 the best; equal rates share a place", ge=1)


def describe_entries(entries: Sequence[Entry]) -> list[RankedEntry]:
    """Describe the entries with their ranks."""
    ranks = rank_entries(entries)
    return [RankedEntry(**dict(one), rank=at) for at, one in zip(ranks, entries, strict=True)]


class LeaderboardState(BaseModel):
    """A season and its entries, the best first."""

    suite: str = Field(description="Version of the suite; scores compare within one")
    began: str | None = Field(
        description="When the season began, UTC, ISO 8601; null before its first measurement"
    )
    not_isolated: str | None = Field(
        description="Why this machine takes no law, as it cannot isolate one; null where it can"
    )
    runs: int = Field(description="How many runs a law is put through")
    entries: list[RankedEntry]
    missing: list[str] = Field(description="Laws of the lab that are not measured on it yet")

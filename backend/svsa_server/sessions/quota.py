"""Disk quota of each user of a class for runs and studies.

A recording that exceeds it is stopped.
"""

import asyncio
from collections import Counter

from svsa.evaluation.studies.store import measure_bytes as measure_studies
from svsa.runs.records.catalogue.entry import CatalogueError
from svsa.runs.records.catalogue.runs import Catalogue
from svsa_server.sessions.laboratory import Laboratory
from svsa_server.sessions.recording import NoCatalogue

CHECK_S = 2.0
_MB = 1e6


class DiskQuota:
    """most_bytes: limit of one person, with runs in the trash, live recordings and studies."""

    def __init__(
        self, catalogue: Catalogue | NoCatalogue, laboratory: Laboratory, most_bytes: float
    ) -> None:
        self._catalogue, self._laboratory, self._most = catalogue, laboratory, most_bytes

    async def check(self, owner: str) -> None:
        """Raise `CatalogueError` if a person has no space for another run."""
        if not owner:
            return
        taken = await asyncio.to_thread(self._catalogue.measure_bytes, owner)
        taken += await asyncio.to_thread(measure_studies, owner)
        taken += self._measure_live()[owner]
        if taken >= self._most:
            raise CatalogueError(
                f"Your runs and studies take {taken / _MB:.0f} MB of the {self._most / _MB:.0f} MB"
                " that each person has here, deleted runs included: delete a study, or ask the"
                " instructor for a larger quota (SVSA_QUOTA_MB)."
            )

    async def run(self) -> None:
        """Check every two seconds until cancelled."""
        while True:
            await asyncio.sleep(CHECK_S)
            await self.stop_recordings_over_quota()

    async def stop_recordings_over_quota(self) -> None:
        """End the recordings of users over their quota; the samples so far are kept."""
        for owner, live in self._measure_live().items():
            taken = live + await asyncio.to_thread(self._catalogue.measure_bytes, owner)
            if taken > self._most:
                self._end_recordings(owner)

    def _end_recordings(self, owner: str) -> None:
        for hosted in self._laboratory.sessions.values():
            recorder = hosted.session.journal.recorder
            if recorder is not None and recorder.header.owner == owner:
                hosted.session.stop_recording()

    def _measure_live(self) -> Counter[str]:
        live: Counter[str] = Counter()
        for hosted in self._laboratory.sessions.values():
            recorder = hosted.session.journal.recorder
            if recorder is not None and recorder.header.owner:
                live[recorder.header.owner] += recorder.status.bytes
        return live

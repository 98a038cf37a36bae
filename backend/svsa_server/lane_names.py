"""What lanes are called, on every page, in 3D and in a replay: by the laws that control them."""

from collections.abc import Sequence
from typing import Any

from svsa.runtime.recording.header import PlantKind
from svsa.runtime.recording.reader import Record

BENCH_LANES = ("Bench", "Twin")


def name_laws(laws: Sequence[Any], plant: PlantKind) -> list[str]:
    """A name for each lane. Where two have one law, the number of the lane stands behind it.

    A bench's first two lanes are the bench itself and its simulated twin.
    """
    written = [str(law).upper() for law in laws]
    names = [
        f"{law} ({lane})" if written.count(law) > 1 else law for lane, law in enumerate(written, 1)
    ]
    if plant != "simulated":
        named = zip(BENCH_LANES, written, strict=False)
        names[: len(BENCH_LANES)] = [f"{name} {law}" for name, law in named]
    return names


def name_lanes(record: Record) -> list[str]:
    """The lanes of a recorded run; those of the record where laws and lanes do not match.

    Lanes do not change while a recording goes on; the law of lane 1 may: "NDOBC → FL".
    """
    header = record.header
    law, rivals = header.configuration.get("law"), header.configuration.get("rivals")
    later: list[str] = []
    for tick, command in record.commands:
        kind, argument = command.get("kind"), command.get("argument")
        if kind == "law" and tick > record.first_tick:
            later.append(str(argument))
        elif kind == "law":
            law = argument
        elif kind == "rivals" and tick <= record.first_tick:
            rivals = argument
    beside = [rival.get("law") for rival in rivals or () if isinstance(rival, dict)]
    if 1 + len(beside) != len(header.lanes):
        return list(header.lanes)
    first, *others = name_laws([law, *beside], header.plant)
    changes = [str(other).upper() for other in dict.fromkeys(later) if other != law]
    return [" → ".join([first, *changes]), *others]

"""What the lanes of a recorded run are called: by the laws that controlled them."""

from typing import Any

from svsa.runtime.recording.reader import Record

BENCH_LANES = ("Bench", "Twin")


def name_lanes(record: Record) -> list[str]:
    """A name for each lane; those of the record where laws and lanes do not match.

    Lanes do not change while a recording goes on; the law of lane 1 may: "NDOBC → FL". Where
    two lanes have one law, their number stands behind it. A bench's first two lanes are the
    bench itself and its simulated twin.
    """
    header = record.header
    law, rivals = header.configuration.get("law"), header.configuration.get("rivals")
    later: list[Any] = []
    for tick, command in record.commands:
        kind, argument = command.get("kind"), command.get("argument")
        if kind == "controller" and tick > record.first_tick:
            later.append(argument)
        elif kind == "controller":
            law = argument
        elif kind == "rivals" and tick <= record.first_tick:
            rivals = argument
    beside = [rival.get("law") for rival in rivals or () if isinstance(rival, dict)]
    laws = [_write(each) for each in (law, *beside)]
    if len(laws) != len(header.lanes):
        return list(header.lanes)
    names = [f"{law} ({lane})" if laws.count(law) > 1 else law for lane, law in enumerate(laws, 1)]
    if header.plant != "simulated":
        named = zip(BENCH_LANES, laws, strict=False)
        names[: len(BENCH_LANES)] = [f"{name} {law}" for name, law in named]
    changes = [law for law in dict.fromkeys(map(_write, later)) if law != laws[0]]
    return [" → ".join([names[0], *changes]), *names[1:]]


def _write(law: Any) -> str:
    return str(law).upper()

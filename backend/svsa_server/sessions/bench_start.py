"""A bench that is opened while the lab is served already: the page says how far it is."""

from collections.abc import Callable

from rich.console import Console

from svsa.errors import SvsaError
from svsa.hardware.session.session import BenchSession
from svsa.runs.session.session import Session
from svsa_server.sessions.lock import take_turn

REPEAT_S = 10.0
_WAY_BACK = (
    "The lab is served without its bench. Mend what is wrong, then press Start loop anew on the"
    " page, or POST /api/v1/sessions/{}/bench/restart."
)


async def open_bench(session: Session, console: Console | None = None) -> None:
    """Open the bench of a session, if it has one, and say on the console how it goes."""
    if not isinstance(session, BenchSession):
        return
    console = console or Console(stderr=True, soft_wrap=True)
    report = show_steps(console)
    try:
        await take_turn(session.open, report)
    except SvsaError as error:
        console.print(str(error), style="bold red", markup=False, highlight=False)
        console.print(_WAY_BACK.format(session.name), markup=False, highlight=False)
    else:
        console.print("The bench is there: it may be armed.", highlight=False)


def show_steps(console: Console) -> Callable[[str, float], None]:
    """What prints a line every ten seconds: what a bench's loop does, and since when."""
    reported_s = 0.0

    def report(step: str, seconds: float) -> None:
        nonlocal reported_s
        if seconds - reported_s >= REPEAT_S:
            reported_s = seconds
            text = f"The bench is {step} ({seconds:.0f} s) …"
            console.print(text, highlight=False, markup=False)

    return report

"""Identity and name of a lane's controller: a law with its gains and its observer."""

from collections import Counter
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from svsa.control.installed import get_law, get_title, is_usable
from svsa.control.observers.disturbance import ObserverBandwidth
from svsa.control.parameters import LawParameters, UnreadParameters
from svsa.runs.definition.configuration import MAX_JOINTS, Configuration
from svsa.runs.definition.design import Lane

BENCH_LANES = ("Bench", "Twin")
JOINTS = tuple(f"Joint {number}" for number in range(1, MAX_JOINTS + 1))


class Controller(NamedTuple):
    """The identity and the name of a curve.

    Attributes:
        place: "Bench" or "Twin" on a bench, "Joint 1", "Joint 2" … of an arm, otherwise "".
        law: Name of the law.
        parameters: Parameters of the law.
        observer: Observer; None if the law does not use it.
        copy: 1, or a higher number for another lane with the same controller.
    """

    place: str
    law: str
    parameters: LawParameters
    observer: ObserverBandwidth | None
    copy: int


def list_controllers(
    configuration: Configuration, is_bench: bool, before: Sequence[Controller | None] = ()
) -> list[Controller]:
    """List the controllers of all lanes; former controllers in `before` keep their numbers."""
    lanes, joints = configuration.lanes, configuration.joints
    places = [""] * len(lanes)
    if is_bench:
        places = [*BENCH_LANES, *places]
    elif len(joints) > 1:
        places = [*JOINTS[: len(joints)]] * len(lanes)
    alone = [
        _build(joints[number % len(joints)], lane, places[number])
        for number, lane in enumerate(lanes)
    ]
    counts, taken, controllers_by_lane = Counter(alone), set[Controller](), dict[int, Controller]()
    kept = dict(enumerate(before))
    for number in sorted(range(len(alone)), key=lambda n: not _is_copy_of(kept.get(n), alone[n])):
        controller, held = alone[number], kept.get(number)
        if counts[controller] > 1 and held is not None and _is_copy_of(held, controller):
            controller = held
        while controller in taken:
            controller = controller._replace(copy=controller.copy + 1)
        taken.add(controller)
        controllers_by_lane[number] = controller
    return [controllers_by_lane[number] for number in range(len(alone))]


def is_shown_together(controller: Controller, other: Controller) -> bool:
    """Whether two controllers are in one plot: all but those of different joints."""
    return controller.place == other.place or controller.place not in JOINTS


def name_controllers(controllers: Iterable[Controller]) -> dict[Controller, str]:
    """Name each controller: lane and law, and for equal laws the differing parameters."""
    described = {controller: _describe(controller) for controller in dict.fromkeys(controllers)}
    alike: dict[tuple[str, str], list[dict[str, str]]] = {}
    for controller, numbers in described.items():
        alike.setdefault((controller.place, controller.law), []).append(numbers)
    differing = {law: _find_differing(numbers) for law, numbers in alike.items()}
    names: dict[Controller, str] = {}
    for controller, numbers in described.items():
        place, law = controller.place, controller.law
        symbols = differing[place, law]
        apart = (f"{symbol} {value}" for symbol, value in numbers.items() if symbol in symbols)
        names[controller] = " ".join(filter(None, (place, get_title(law), *apart)))
    return _number_doubles(names)


def _build(configuration: Configuration, lane: Lane, place: str) -> Controller:
    if not is_usable(lane.law):
        written = configuration.find_parameters(lane) or UnreadParameters()
        return Controller(place, lane.law, written, None, 1)
    is_observing = get_law(lane.law).estimate == "observer"
    observer = (lane.observer or configuration.observer) if is_observing else None
    return Controller(place, lane.law, configuration.get_parameters(lane), observer, 1)


def _is_copy_of(held: Controller | None, controller: Controller) -> bool:
    return held is not None and held._replace(copy=1) == controller


def _find_differing(described: Sequence[dict[str, str]]) -> set[str]:
    """Return the symbols of the numbers that differ between controllers or that some lack."""
    symbols = {symbol for numbers in described for symbol in numbers}
    return {symbol for symbol in symbols if len({numbers.get(symbol) for numbers in described}) > 1}


def _describe(controller: Controller) -> dict[str, str]:
    """Format its numbers with symbols; β is the observer's, rad/s."""
    betas = controller.observer.bandwidth_rad_per_s if controller.observer else ()
    shown = betas[:1] if len(set(betas)) == 1 else betas
    beta = {"β": "/".join(f"{beta:.3g}" for beta in shown)} if betas else {}
    return beta | controller.parameters.describe()


def _number_doubles(names: dict[Controller, str]) -> dict[Controller, str]:
    """Number names that are still equal, in order of appearance."""
    seen = Counter[str]()
    numbered: dict[Controller, str] = {}
    for controller, name in names.items():
        seen[name] += 1
        numbered[controller] = name if seen[name] == 1 else f"{name} ({seen[name]})"
    return numbered

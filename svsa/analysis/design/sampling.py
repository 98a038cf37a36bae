"""How fast the observer may be under sampling, delay and estimation."""

from svsa.analysis.design.sampled_loop import linearize_tick
from svsa.control.installed import get_law
from svsa.control.observers.disturbance import ObserverBandwidth
from svsa.runs.configuration import Configuration

SLOWEST_RAD_PER_S, FASTEST_RAD_PER_S = 1.0, 1000.0
_STRIDE = 1.3
_CLOSE = 1e-3


def find_fastest_observer(configuration: Configuration, sigma: float) -> float | None:
    """The bandwidth β, rad/s, below which the sampled loop about rest is stable; 0 where none is.

    The same β on all three channels. configuration: with its sampling, delay and estimator (see
    `choose_sensing`); counts, noise and friction have no part in it. None where it is still
    stable at `FASTEST_RAD_PER_S`, and for a law that acts on no observer.
    """
    if get_law(configuration.law).estimate != "observer":
        return None

    def is_stable(beta: float) -> bool:
        observer = ObserverBandwidth(bandwidth_rad_per_s=(beta, beta, beta))
        return linearize_tick(configuration.changed(observer=observer), sigma).radius < 1.0

    stable, unstable = SLOWEST_RAD_PER_S, SLOWEST_RAD_PER_S
    while is_stable(unstable):
        stable = unstable
        if stable == FASTEST_RAD_PER_S:
            return None
        unstable = min(stable * _STRIDE, FASTEST_RAD_PER_S)
    if unstable == SLOWEST_RAD_PER_S:
        return 0.0
    while unstable - stable > _CLOSE * stable:
        middle = 0.5 * (stable + unstable)
        if is_stable(middle):
            stable = middle
        else:
            unstable = middle
    return stable

"""Latency from sending a current to reading it in the feedback, over many small steps."""

import numpy as np

from svsa.hardware.commissioning.probe import Probe
from svsa.hardware.commissioning.step import CheckStep, Result
from svsa.hardware.commissioning.traffic import Traffic

STEPS = 40
CURRENT = 0.05
MIN_MA = 100.0
LOST_S = 0.03


def check_latency(probe: Probe, name: str) -> CheckStep:
    """Measure the latency from sending a current to reading it in the feedback."""
    title = f"{name}: latency"
    nominal_ma = 1e3 * probe.motors[name].nominal_current_a
    current = round(min(max(CURRENT * nominal_ma, MIN_MA), 0.15 * nominal_ma))
    delays: list[float] = []
    try:
        for number in range(STEPS):
            probe.drain()
            sign, sent = (1, -1)[number % 2], probe.now()
            probe.send_current(name, sign * current)
            traffic = Traffic()
            for _ in probe.follow(LOST_S, traffic):
                heard = traffic.feedback.get(name)
                if heard and 2 * sign * heard[-1].current_ma >= current:
                    delays.append(heard[-1].time_s - sent)
                    break
            probe.send_current(name, 0)
            # Pauses of different lengths sample different phases of the feedback period.
            probe.listen(0.006 + 0.00037 * (number % 8))
    finally:
        probe.send_current(name, 0)
    if len(delays) < 0.9 * STEPS:
        return CheckStep(
            title,
            Result.WARN,
            f"the current followed in {len(delays)} of {STEPS} steps of {current} mA",
            "The drive's current loop is slow, or its measurement too coarse for steps of this"
            f" size: check {probe.families[name].advice.current}, and the supply.",
        )
    median, p99 = (1e3 * float(np.percentile(delays, share)) for share in (50, 99))
    measured = f"{current} mA seen after {median:.2f} ms (median), {p99:.2f} ms (99 %)"
    period_ms = 1e3 * probe.bench.timing.period_s
    if median > 3.0 * period_ms or p99 > 1e3 * probe.bench.safety.stale_zero_s:
        advice = (
            "This latency is long for the control period: use a faster adapter, or a period_s"
            " of 0.002 with gains made for it."
        )
        return CheckStep(title, Result.WARN, measured, advice)
    return CheckStep(title, Result.OK, measured)

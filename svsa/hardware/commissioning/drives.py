"""Is the bus in order, do both drives answer, and do they take the current mode?"""

import numpy as np

from svsa.hardware.commissioning.probe import CheckStep, Probe, Result, Traffic
from svsa.hardware.drives.drive import MARGIN_S, SETTLE_S
from svsa.hardware.drives.robomodule import Address, Config, Mode, Online, Reset, SetMode
from svsa.hardware.file import BenchFile

QUIET_S = 0.3
ECHOES = 20
ATTEMPTS = 3
ECHO_S = 0.05
SLOW_ECHO_S = 0.002

WIRING = (
    "CAN_H to CAN_H, CAN_L to CAN_L and ground; 120 Ω at both ends of the bus and nowhere else"
    " (60 Ω between CAN_H and CAN_L with the power off); every node at the bit rate of the bench"
    " file (the drives leave the factory at 1 Mbit/s)"
)
DRIVE_POWER = "the drive's supply is on and within 7 V to 33 V"


def check_bus(probe: Probe) -> CheckStep:
    """Listen only: error frames, and whether another program commands the drives."""
    traffic = probe.listen(QUIET_S)
    bus = probe.bench.bus
    emulated = ", EMULATED: no machine is behind this bus" if probe.emulated else ""
    measured = (
        f"{bus.interface} {bus.channel} is open, {bus.bitrate / 1000:g} kbit/s,"
        f" {traffic.frames / QUIET_S:.0f} frames/s, {traffic.bus_errors} error frames{emulated}"
    )
    others = traffic.commands & {
        *probe.motors.values(),
        *(Address(address.group, 0) for address in probe.motors.values()),
    }
    if others or any(traffic.feedback.get(address) for address in probe.motors.values()):
        advice = (
            "A drive is in use: another program sends it commands or has left it in a mode. End"
            " that program (the lab's server, another check), switch the drives off and on."
        )
        if others:
            return CheckStep("bus", Result.FAIL, measured, advice)
        return CheckStep("bus", Result.WARN, measured, advice)
    if traffic.bus_errors:
        return CheckStep("bus", Result.FAIL, measured, advise_on_bus(probe.bench))
    return CheckStep("bus", Result.OK, measured)


def advise_on_bus(bench: BenchFile) -> str:
    """What to look at where the bus does not open or is full of errors."""
    bus = bench.bus
    return (
        f"Check that the adapter is plugged in, that its name {bus.channel} is right and that its"
        f" interface is up (for SocketCAN: `ip link set {bus.channel} up type can bitrate"
        f" {bus.bitrate}`). Then the wiring: {WIRING}."
    )


def check_drive(probe: Probe, name: str, address: Address) -> CheckStep:
    """The online check, many times: does the drive answer, and how soon."""
    title = f"{name}: drive {address.group}.{address.number}"
    probe.drain()
    delays = []
    for attempt in range(ECHOES):
        traffic, sent = Traffic(), probe.now()
        probe.send(address, Online())
        for _ in probe.follow(ECHO_S, traffic):
            if address in traffic.online:
                delays.append(traffic.online[address][0] - sent)
                break
        # A drive that is silent three times is not waited for seventeen times more.
        if attempt == ATTEMPTS - 1 and not delays:
            break
    if not delays:
        return CheckStep(title, Result.FAIL, "no answer", _advise_on_silence(probe, address))
    median, worst = 1e3 * float(np.median(delays)), 1e3 * max(delays)
    measured = (
        f"{len(delays)} of {ECHOES} online checks echoed, after {median:.2f} ms (worst"
        f" {worst:.2f} ms)"
    )
    if len(delays) < ECHOES:
        return CheckStep(title, Result.FAIL, measured, f"Frames are lost. Check: {WIRING}.")
    if median > 1e3 * SLOW_ECHO_S:
        advice = (
            "The adapter is too slow for a loop of 1 kHz: set the latency timer of a USB serial"
            " adapter to 1 ms, use a driver without polling, or a period_s of 0.002."
        )
        return CheckStep(title, Result.WARN, measured, advice)
    return CheckStep(title, Result.OK, measured)


def _advise_on_silence(probe: Probe, address: Address) -> str:
    """Ask every address, and say where a drive does answer."""
    everywhere = [Address(group, number) for group in range(8) for number in range(1, 16)]
    traffic = Traffic()
    for other in everywhere:
        probe.send(other, Online())
        for _ in probe.follow(0.001, traffic):
            pass
    for _ in probe.follow(0.1, traffic):
        pass
    known = set(probe.motors.values())
    strangers = sorted(set(traffic.online) - known)
    if strangers:
        places = ", ".join(f"group {a.group} number {a.number}" for a in strangers)
        return (
            f"A drive answers at {places}: set it to group {address.group} number"
            f" {address.number} with the maker's program, or correct the bench file."
        )
    if traffic.online:
        return (
            f"Only the other drive answers. Check that {DRIVE_POWER}, its bus connector, and"
            " that it is not still at the factory address (group 0, number 1) together with the"
            " other: switch the other one off and run the check again."
        )
    return f"No drive answers at any address. Check that {DRIVE_POWER}. Then the wiring: {WIRING}."


def bring_up(probe: Probe) -> CheckStep:
    """Reset, configuration, current mode, zero current, with the drive's waits between."""
    period_ms = get_period_ms(probe.bench)
    for address in probe.motors.values():
        probe.send(address, Reset())
    probe.listen(MARGIN_S)
    after_reset = probe.listen(SETTLE_S)
    obstinate = [name for name, address in probe.motors.items() if address in after_reset.feedback]
    if obstinate:
        return CheckStep(
            "mode sequence",
            Result.FAIL,
            f"{' and '.join(obstinate)} did not leave its mode at the reset",
            "Switch the drives off and on, and see that no other program uses the bus.",
        )
    for message in (Config(period_ms, 0), SetMode(Mode.CURRENT)):
        for address in probe.motors.values():
            probe.send(address, message)
        probe.listen(MARGIN_S)
    taken = probe.listen(SETTLE_S)
    for name in probe.motors:
        probe.send_current(name, 0)
    refused = [name for name, address in probe.motors.items() if address not in taken.feedback]
    if refused:
        return CheckStep(
            "mode sequence",
            Result.FAIL,
            f"{' and '.join(refused)} sent no feedback after the current mode was set",
            "The drive has not taken the mode: switch it off and on and try again; check that its"
            " firmware speaks the protocol of 2018-07 and that its supply does not break down.",
        )
    return CheckStep(
        "mode sequence", Result.OK, "reset, 0.5 s, current mode, 0.5 s, zero current: taken"
    )


def get_period_ms(bench: BenchFile) -> int:
    """Of the feedback frames: the control period, in whole ms."""
    return max(1, round(1000.0 * bench.timing.period_s))

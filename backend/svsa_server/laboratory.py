"""The sessions of this server and the background tasks that keep them going."""

import asyncio
import logging
import time

from svsa.experiment.paper import get_figure
from svsa.plant.disturbances import PAPER_MASS_KG, MassLoad, PaperLoad
from svsa.runtime.session import Session
from svsa.signals import CHANNEL_INDEX
from svsa_scene import ActuatorPose
from svsa_server.errors import UnknownError

WAKE_PERIOD_S = 1.0 / 120.0
SHARED_SESSION = "lab"

_log = logging.getLogger("svsa")


class Laboratory:
    """The sessions by name. The shared one starts on Figure 4A, the load in your hand."""

    def __init__(self) -> None:
        shared = Session(SHARED_SESSION, get_figure("4a").build_configuration(load=False))
        shared.start()
        self.sessions = {shared.name: shared}

    def get(self, name: str) -> Session:
        """The session of this name; raises `UnknownError`."""
        if name not in self.sessions:
            known = ", ".join(self.sessions)
            raise UnknownError(f"There is no session {name[:80]!r}; sessions here: {known}.")
        return self.sessions[name]

    async def run(self) -> None:
        """Wake every session 120 times a second until cancelled."""
        while True:
            for session in self.sessions.values():
                self._wake(session)
            await asyncio.sleep(WAKE_PERIOD_S)

    def _wake(self, session: Session) -> None:
        """An error in one session pauses that session and stops no other."""
        try:
            session.wake(time.monotonic())
        except Exception:
            _log.exception("Session %s was paused by an error of the program", session.name)
            session.pause()

    def read_pose(self) -> ActuatorPose | None:
        """The shared session's newest sample as the 3D view needs it; None before the first."""
        session = self.sessions[SHARED_SESSION]
        newest = session.history.read_newest()
        if newest is None:
            return None

        def read(channel: str) -> float:
            return float(newest[CHANNEL_INDEX[channel]])

        return ActuatorPose(
            position_rad=read("position_rad"),
            position_reference_rad=read("position_reference_rad"),
            motor1_position_rad=read("motor1_position_rad"),
            motor2_position_rad=read("motor2_position_rad"),
            lever_ratio=read("lever_ratio"),
            stiffness_nm_per_rad=read("stiffness_nm_per_rad"),
            torque1_nm=read("torque1_nm"),
            torque2_nm=read("torque2_nm"),
            disturbance_link_nm=read("disturbance_link_nm"),
            load_mass_kg=_find_hung_mass(session),
            deflection_limit_rad=read("deflection_limit_rad"),
        )


def _find_hung_mass(session: Session) -> float:
    mass = 0.0
    for _, load, start, end in session.run.loads:
        if start <= session.run.tick < end:
            if isinstance(load, MassLoad):
                mass += load.mass_kg
            elif isinstance(load, PaperLoad):
                mass += PAPER_MASS_KG
    return mass

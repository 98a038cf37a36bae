"""The 3D view beside the server: viser on loopback, fed with the pose of the running session."""

import asyncio
import contextlib
import io
from collections.abc import Callable

import viser

from svsa_scene import ActuatorPose, ActuatorScene

UPDATE_RATE_HZ = 30.0


class _LoopbackViser(viser.ViserServer):
    """A viser server that never opens a public tunnel, whoever asks for one."""

    def request_share_url(self, verbose: bool = True) -> str | None:
        return None


class SceneBridge:
    """Starts viser on 127.0.0.1 at a free port and keeps its scene at the session's pose."""

    def __init__(self) -> None:
        with contextlib.redirect_stdout(io.StringIO()):
            self._viser = _LoopbackViser(host="127.0.0.1", port=0, verbose=False)
        self._scene = ActuatorScene(self._viser)
        self._stopped = False

    @property
    def port(self) -> int:
        """The loopback port on which viser listens."""
        return self._viser.get_port()

    @property
    def viewers(self) -> int:
        """How many browsers show the view now."""
        return len(self._viser.get_clients())

    def set_theme(self, dark: bool) -> None:
        """Light or dark background for viewers that do not choose one by `?darkMode`."""
        self._scene.set_theme(dark)

    async def run(self, read_pose: Callable[[], ActuatorPose | None]) -> None:
        """Show `read_pose()` 30 times a second until cancelled or stopped.

        Nothing is read or sent while nobody watches, nor while there is no pose.
        """
        loop = asyncio.get_running_loop()
        due = loop.time()
        while not self._stopped:
            if self.viewers:
                pose = read_pose()
                if pose is not None:
                    self._scene.update(pose)
            due = max(due + 1.0 / UPDATE_RATE_HZ, loop.time())
            await asyncio.sleep(due - loop.time())

    def stop(self) -> None:
        """Close viser and its connections. Takes up to a second; may be called again."""
        if not self._stopped:
            self._stopped = True
            self._viser.stop()

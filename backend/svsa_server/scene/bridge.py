"""A 3D view of a session: viser on loopback."""

import contextlib
import io
import socket

import viser
from viser.infra import WebsockClientConnection

from svsa.runs.definition.configuration import Configuration
from svsa_scene import ActuatorPose
from svsa_scene.arm import ArmScene
from svsa_scene.arm_pose import ArmPose
from svsa_scene.scene import ActuatorScene
from svsa_server.scene.viser_proxy import SCENE_BUFFER_BYTES


class _LoopbackViser(viser.ViserServer):
    """A viser server for connections of this machine.

    It never opens a public tunnel, also on request. A proxy that waits for a slow browser does not
    answer its pings, and is not disconnected. The system must not buffer many old poses for it.
    """

    def __init__(self) -> None:
        super().__init__(host="127.0.0.1", port=0, verbose=False)
        self._websock_server.on_client_connect(self._prepare_for_slow_proxy)

    def _prepare_for_slow_proxy(self, client: WebsockClientConnection) -> None:
        connection = self._websock_server._live_connections[client.client_id]
        connection.ping_timeout = None
        connection.transport.set_write_buffer_limits(SCENE_BUFFER_BYTES)
        plain: socket.socket = connection.transport.get_extra_info("socket")
        plain.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, SCENE_BUFFER_BYTES)

    def request_share_url(self, verbose: bool = True) -> str | None:
        return None


class SceneBridge:
    """Starts viser on 127.0.0.1 at a free port, with the actuator or the arm as its scene."""

    def __init__(self, configuration: Configuration) -> None:
        with contextlib.redirect_stdout(io.StringIO()):
            self._viser = _LoopbackViser()
        self._scene = _build_scene(self._viser, configuration)
        self._stopped = False

    @property
    def port(self) -> int:
        """The loopback port on which viser listens."""
        return self._viser.get_port()

    @property
    def viewers(self) -> int:
        """Number of browsers that show the view now."""
        return len(self._viser.get_clients())

    def set_theme(self, dark: bool) -> None:
        """Light or dark background for viewers that do not choose one by `?darkMode`."""
        self._scene.set_theme(dark)

    def show(self, pose: ActuatorPose | ArmPose) -> None:
        """Move the actuator or the arm to the pose, in every browser that shows it. A pose of the
        other kind, just after another experiment has been loaded, is left out.
        """
        match self._scene, pose:
            case (ActuatorScene() as scene, ActuatorPose()):
                scene.update(pose)
            case (ArmScene() as scene, ArmPose()):
                scene.update(pose)
            case _:
                pass

    def stop(self) -> None:
        """Close viser and its connections. Takes up to a second; may be called again."""
        if not self._stopped:
            self._stopped = True
            with contextlib.redirect_stdout(io.StringIO()):
                self._viser.stop()


def _build_scene(
    server: viser.ViserServer, configuration: Configuration
) -> ActuatorScene | ArmScene:
    if configuration.arm is None:
        return ActuatorScene(server, configuration.actuator)
    actuators = [joint.actuator for joint in configuration.joints]
    return ArmScene(server, configuration.arm.links, actuators)

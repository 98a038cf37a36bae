"""The other lanes, live: their links as outlines, with ink and name of who controls them."""

import viser

from svsa_scene import appearance as look
from svsa_scene import mechanism
from svsa_scene.geometry import turn
from svsa_scene.moved import Moved
from svsa_scene.names import add_label
from svsa_scene.pose import RivalPose


class Rivals:
    """Outlines for as many other lanes as a session may have; those without one are hidden."""

    def __init__(self, server: viser.ViserServer, moved: Moved) -> None:
        self._moved = moved
        self._scene = scene = server.scene
        self._names = [""] * look.MAX_RIVALS
        self._inks = [number + 1 for number in range(look.MAX_RIVALS)]
        self._frames = [
            scene.add_frame(f"/a/r{number}", show_axes=False, visible=False)
            for number in range(look.MAX_RIVALS)
        ]
        self._labels = []
        for number in range(look.MAX_RIVALS):
            self._paint(number)
            self._labels.append(
                add_label(
                    server, f"/a/r{number}/t", "", (mechanism.compute_rival_tip(number), 0.15, 0.9)
                )
            )

    def show(self, rivals: tuple[RivalPose, ...]) -> None:
        """Each rival at its position; at most as many as there are outlines."""
        for number, frame in enumerate(self._frames):
            rival = rivals[number] if number < len(rivals) else None
            name = rival.name if rival else ""
            if rival and rival.ink != self._inks[number]:
                self._inks[number] = rival.ink
                self._paint(number)
            if name != self._names[number]:
                self._names[number] = name
                frame.visible = bool(name)
                if name:
                    self._labels[number].text = name
            if rival and self._moved.is_due(f"rival{number}", (rival.position_rad,)):
                frame.wxyz = turn(rival.position_rad)

    def _paint(self, number: int) -> None:
        """The outline in its ink, in place of the one before."""
        finish = look.Finish(look.get_ink_color(self._inks[number]), 0.0, 0.7, 0.75)
        solid = mechanism.export(mechanism.build_rival, finish, number)
        self._scene.add_glb(f"/a/r{number}/solid", solid)

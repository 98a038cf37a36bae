"""The deflection limit: two marks and the arc between them, on the principal motor."""

import viser

from svsa_scene import appearance as look
from svsa_scene import mechanism
from svsa_scene.geometry import make_sector, scale_sector, turn
from svsa_scene.moved import Moved

PIECES = 6
_INNER, _OUTER = 1.16, 1.2


class DeflectionLimit:
    """An arc of straight pieces, which move only when the limit changes (it depends on μ)."""

    def __init__(self, server: viser.ViserServer, moved: Moved, root: str) -> None:
        self._moved = moved
        scene = server.scene
        piece = make_sector(_INNER, _OUTER)
        self._pieces = [
            scene.add_mesh_simple(
                f"{root}/c/i{number}",
                piece.vertices,
                piece.faces,
                color=look.LIMIT.color,
                side="double",
                position=(0.0, 0.0, mechanism.SECTOR_Z),
                cast_shadow=False,
            )
            for number in range(PIECES)
        ]
        self._marks = []
        for name in ("m", "n"):
            self._marks.append(scene.add_frame(f"{root}/c/{name}", show_axes=False))
            glb = mechanism.export(mechanism.build_limit_mark)
            scene.add_glb(f"{root}/c/{name}/solid", glb)

    def show(self, limit_rad: float) -> None:
        """From −limit to +limit."""
        if not self._moved.is_due("limit", (limit_rad,)):
            return
        for mark, angle in zip(self._marks, (-limit_rad, limit_rad), strict=True):
            mark.wxyz = turn(angle)
        width = 2 * limit_rad / PIECES
        for number, piece in enumerate(self._pieces):
            piece.wxyz = turn((number + 0.5) * width - limit_rad)
            piece.scale = scale_sector(width)

"""Names of the parts, each on a line from its part, and the motors' angles.

The names are hidden until a viewer asks: every browser shows them for itself alone
(`frontend/web/src/scene/viewer.ts` knows them by their nodes).
"""

from typing import NamedTuple

import numpy as np
import viser

_INK = (128, 138, 150)


class PartName(NamedTuple):
    """A name at the end of a line. node: below the frame that it moves with. part, place: where
    the line begins and ends, scene units of that frame.
    """

    node: str
    text: str
    part: tuple[float, float, float]
    place: tuple[float, float, float]


SYMBOLS = (
    PartName("/a/t1", "θ₁", (-0.48, 0.0, -2.68), (-1.05, 0.0, -2.68)),
    PartName("/a/t2", "θ₂", (-0.4, 0.0, -0.72), (-1.3, 0.0, -0.72)),
)
NAMES = (
    PartName("/a/n1", "principal motor", (0.3, 0.37, -2.8), (1.2, 0.7, -2.8)),
    PartName("/a/n2", "stiffness motor", (0.25, 0.31, -0.9), (1.5, 0.9, -0.9)),
    PartName("/a/c/n3", "spiral", (0.33, -0.42, 0.27), (0.95, -1.1, 0.5)),
    PartName("/a/c/p/n4", "pivot", (0.0, 0.0, 1.05), (-0.5, -0.95, 1.0)),
    PartName("/a/l/n5", "lever", (-0.6, 0.085, 0.86), (-1.25, 0.6, 1.35)),
    PartName("/a/l/n6", "spring", (0.0, -0.4, 1.05), (0.2, -1.28, 0.45)),
)


def add_names(server: viser.ViserServer) -> None:
    """The angles in sight, unless a part is before them; the names hidden."""
    for one in SYMBOLS:
        _add(server, one, is_seen=True)
    for one in NAMES:
        _add(server, one, is_seen=False)


def _add(server: viser.ViserServer, name: PartName, *, is_seen: bool) -> None:
    scene = server.scene
    scene.add_frame(name.node, show_axes=False, visible=is_seen)
    points = np.array([[name.part, name.place]])
    scene.add_line_segments(f"{name.node}/l", points, _INK, thickness=1.5, thickness_units="screen")
    scene.add_label(
        f"{name.node}/t",
        name.text,
        position=name.place,
        anchor="center-center",
        font_screen_scale=1.0,
        depth_test=is_seen,
    )

"""Labels of the scene: each at its part, where its line begins.

The page lays them out on the picture without overlap (`frontend/web/src/lab/scene/labels.tsx`); in
a viewer without the page they are at the parts. The names of the parts are hidden until a viewer
requests them: every browser shows them for itself only (`frontend/web/src/lab/scene/viewer.ts`
knows their nodes).
"""

from typing import NamedTuple

import viser

from svsa.actuators.mechanism import Mechanism
from svsa.actuators.parameters import SVSA
from svsa_scene.mechanism import SECTOR_Z, SPRING_Z

Point = tuple[float, float, float]


class PartLabel(NamedTuple):
    """A label for a part.

    Attributes:
        node: Name of its frame, a child of the part with which it moves.
        text: The label.
        place: Point of the part, scene units of that frame.
    """

    node: str
    text: str
    place: Point


SYMBOLS = (
    PartLabel("/a/c/t0", "φ", (-1.08, 0.0, SECTOR_Z)),
    PartLabel("/a/l/t0", "q", (1.14, 0.0, 0.92)),
    PartLabel("/a/g/t0", "q_d", (1.56, 0.0, 0.92)),
    PartLabel("/a/t1", "θ₁", (-0.48, 0.0, -2.68)),
    PartLabel("/a/t2", "θ₂", (-0.4, 0.0, -0.72)),
)
NAMES = (
    PartLabel("/a/n1", "principal motor", (0.0, 0.49, -2.8)),
    PartLabel("/a/n2", "stiffness motor", (0.0, 0.41, -0.95)),
    PartLabel("/a/c/s/n3", "spiral", (0.0, -0.56, 0.28)),
    PartLabel("/a/c/p/n4", "pivot", (0.0, 0.0, 1.06)),
    PartLabel("/a/l/v/n5", "lever", (0.18, 0.085, 0.87)),
    PartLabel("/a/l/n6", "spring", (0.0, -0.42, 1.07)),
)


def add_label(server: viser.ViserServer, node: str, text: str, place: Point) -> viser.LabelHandle:
    """A label at a place of the frame that its node lies in; never smaller with the distance."""
    return server.scene.add_label(
        node, text, position=place, anchor="center-center", font_screen_scale=1.0
    )


def add_part_labels(server: viser.ViserServer, mechanism: Mechanism) -> None:
    """Add the visible symbols, and the names of the parts, hidden.

    For an actuator other than the SVSA only the motors have a name; θ2 and its motor are left out
    if there is none.
    """
    names = NAMES if mechanism.name == SVSA else NAMES[:2]
    missing = set() if mechanism.has_stiffness_motor else {"/a/t2", "/a/n2"}
    for one in (*SYMBOLS, *names):
        if one.node in missing:
            continue
        server.scene.add_frame(one.node, show_axes=False, visible=one in SYMBOLS)
        add_label(server, f"{one.node}/t", one.text, one.place)
    if mechanism.name != SVSA:
        server.scene.add_frame("/a/c/t3", show_axes=False)
        add_label(server, "/a/c/t3/t", mechanism.title, (0.0, 0.75, SPRING_Z))

"""The comparison lanes, live: their links as outlines, with line style and controller name."""

import viser

from svsa_scene import appearance as look
from svsa_scene import mechanism
from svsa_scene.geometry import turn
from svsa_scene.moved import Moved
from svsa_scene.names import add_label
from svsa_scene.pose import ComparisonPose


class Comparisons:
    """Outlines for as many other lanes as a session may have; those without one are hidden."""

    def __init__(self, server: viser.ViserServer, moved: Moved) -> None:
        self._moved = moved
        self._scene = scene = server.scene
        self._names = [""] * look.MAX_COMPARISONS
        self._line_styles = [number + 1 for number in range(look.MAX_COMPARISONS)]
        self._frames = [
            scene.add_frame(f"/a/r{number}", show_axes=False, visible=False)
            for number in range(look.MAX_COMPARISONS)
        ]
        self._labels = []
        for number in range(look.MAX_COMPARISONS):
            self._paint(number)
            self._labels.append(
                add_label(
                    server,
                    f"/a/r{number}/t",
                    "",
                    (mechanism.compute_comparison_tip(number), 0.15, 0.9),
                )
            )

    def show(self, comparisons: tuple[ComparisonPose, ...]) -> None:
        """Each comparison at its position; at most as many as there are outlines."""
        for number, frame in enumerate(self._frames):
            comparison = comparisons[number] if number < len(comparisons) else None
            name = comparison.name if comparison else ""
            if comparison and comparison.line_style != self._line_styles[number]:
                self._line_styles[number] = comparison.line_style
                self._paint(number)
            if name != self._names[number]:
                self._names[number] = name
                frame.visible = bool(name)
                if name:
                    self._labels[number].text = name
            if comparison and self._moved.is_due(f"comparison{number}", (comparison.position_rad,)):
                frame.wxyz = turn(comparison.position_rad)

    def _paint(self, number: int) -> None:
        """Draw the outline in its line style, in place of the previous one."""
        finish = look.Finish(look.get_line_color(self._line_styles[number]), 0.0, 0.7, 0.75)
        solid = mechanism.export(mechanism.build_comparison, finish, number)
        self._scene.add_glb(f"/a/r{number}/solid", solid)

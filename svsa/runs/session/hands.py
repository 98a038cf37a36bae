"""What is asked of whoever stands at a bench."""

from svsa.simulation.plant.loads import Load


class Hands:
    """A person, who needs no telling; a stand-in does what it is told."""

    def hang(self, loads: tuple[Load, ...]) -> None:
        """These loads and no others are on."""

    def set_to_marks(self) -> None:
        """Set the mechanism to its zero marks, before it is armed."""

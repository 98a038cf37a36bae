"""Adversaries: the loads and perturbations that a falsification may use, with bounds."""

from svsa.evaluation.falsifier.file import ADVERSARY_FOLDER, list_adversaries, read_adversary
from svsa_server.access.permissions import OBSERVER, allow
from svsa_server.routing import build_router
from svsa_server.schemas.evaluation.falsification import AdversaryState

router = build_router("/adversaries", tags=["falsifier"])


@router.get("")
@allow(OBSERVER)
def list_adversary_files() -> list[AdversaryState]:
    """List the adversaries of this lab: the loads that each may choose, and its cost."""
    return [
        AdversaryState(
            name=name,
            title=title,
            text=(ADVERSARY_FOLDER / f"{name}.toml").read_text(encoding="utf-8"),
            definition=read_adversary(name).model_dump(mode="json"),
        )
        for name, title in list_adversaries().items()
    ]

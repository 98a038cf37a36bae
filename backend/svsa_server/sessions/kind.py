"""What a session simulates: experiments of the lab can be set up in a session of the same kind."""

from svsa.actuators.installed import find_mechanism
from svsa.actuators.parameters import SVSA
from svsa.errors import StateError
from svsa.runs.definition.configuration import Configuration
from svsa.runs.session.session import Session


def check_svsa(session: Session) -> None:
    """Raise `StateError` if the session is of an arm, or of another actuator than the SVSA."""
    configuration = session.run.configuration
    mechanism = find_mechanism(configuration.actuator)
    if configuration.arm is not None:
        raise StateError(
            "Figures of the paper and most exercises are experiments of a single joint, and this"
            " session is of an arm: use the lab, or open a session of the SVSA."
        )
    if mechanism.name != SVSA:
        raise StateError(
            f"Figures of the paper and exercises are experiments of the SVSA, and this session"
            f" is of {mechanism.title}: use the lab, or open a session of the SVSA."
        )


def check_arm(session: Session, configuration: Configuration, name: str) -> None:
    """Raise `StateError` if the session is not of the arm of this name: links and actuators."""
    if _describe_arm(session.run.configuration) != _describe_arm(configuration):
        raise StateError(
            f"This experiment is of the arm {name!r}, and this session is not: open a session of"
            " this arm."
        )


def _describe_arm(configuration: Configuration) -> tuple[object, ...]:
    """Return what the 3D view of a session cannot change: link lengths and mechanisms."""
    arm = configuration.arm
    if arm is None:
        return ()
    mechanisms = (find_mechanism(joint.actuator).name for joint in configuration.joints)
    return (*(link.length_m for link in arm.links.chain), *mechanisms)

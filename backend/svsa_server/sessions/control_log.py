"""What nobody called for, in the audit log: control that goes on by itself."""

from svsa_server.access.audit import AuditLog
from svsa_server.leases.lease import Settled
from svsa_server.sessions.hosted import HostedSession


def note_settled(log: AuditLog, hosted: HostedSession, settled: Settled) -> None:
    """Write who was let go and why, at which tick, and who is in control now."""
    log.write(
        event="control",
        why=settled.why,
        person=settled.who.client,
        name=settled.who.name,
        session=hosted.session.name,
        **hosted.read_instant(),
    )

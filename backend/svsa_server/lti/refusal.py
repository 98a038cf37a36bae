"""A launch that is not taken."""

from svsa.errors import SvsaError


class LaunchError(SvsaError):
    """Why a login or a launch was refused, for who launched and for the audit log."""

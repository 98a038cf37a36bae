"""The error of a rejected launch; separate from the keys, which need the extra `lti`."""

from svsa.errors import SvsaError


class LaunchError(SvsaError):
    """Why a login or a launch was rejected, for the user who launched and for the audit log."""

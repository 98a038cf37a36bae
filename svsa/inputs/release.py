"""Which release of the library this is."""

from importlib.metadata import PackageNotFoundError, version

from svsa.inputs.extras import DISTRIBUTION

try:
    __version__ = version(DISTRIBUTION)
except PackageNotFoundError:
    __version__ = "0+uninstalled"

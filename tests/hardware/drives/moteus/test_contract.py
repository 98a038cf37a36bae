"""moteus controllers fulfil the contract of all families: CAN FD, feedback by query only."""

from tests.hardware.drives.contract import DriveContract


class TestMoteus(DriveContract):
    family = "moteus"
    addresses = ({"id": 1}, {"id": 2})
    fd = True

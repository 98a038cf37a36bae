"""RoboModule drives fulfil the contract of all families."""

from tests.hardware.drives.contract import DriveContract


class TestRoboModule(DriveContract):
    family = "robomodule"
    addresses = (
        {"drive_number": 1, "counts_per_rev": 2000},
        {"drive_number": 2, "counts_per_rev": 2000},
    )

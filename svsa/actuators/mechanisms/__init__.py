"""The actuators of this lab, a file each, found by the entry points `svsa.actuators`."""

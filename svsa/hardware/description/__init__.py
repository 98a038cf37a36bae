"""A bench as it is described: its file, its calibration record and its DBC file."""

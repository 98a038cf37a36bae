"""The compiled control loop: many ticks per call, tick by tick, and with a measured plant."""

"""The control loop, compiled: many ticks a call, tick by tick, and around a measured plant."""

"""The datasheet of an actuator, measured on its simulation (Grioli et al., IJRR 2015)."""

"""The actuator: lever, spring, dynamics, linearization and the domain they hold in."""

"""The RoboModule drives and their bus."""

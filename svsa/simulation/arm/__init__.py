"""The compiled loop of an arm: a controller for each joint on a coupled plant."""

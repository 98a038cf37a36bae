"""The compiled loop of an arm: two joints with a controller each on a coupled plant."""

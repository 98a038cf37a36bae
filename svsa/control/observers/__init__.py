"""What the controller believes about what it cannot measure."""

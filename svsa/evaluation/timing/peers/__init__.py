"""The plant of a run solved by others, to the accuracy that it has here."""

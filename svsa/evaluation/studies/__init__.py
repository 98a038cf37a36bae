"""Studies: many perturbed runs of every law, and what can be said of them."""

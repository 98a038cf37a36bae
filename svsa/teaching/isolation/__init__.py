"""An untrusted control law, in a process of its own that can only compute."""

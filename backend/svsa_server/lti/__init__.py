"""LTI 1.3: a learning platform launches people into the class, and gets their points back."""

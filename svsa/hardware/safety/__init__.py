"""What watches a bench, and what is done when something is wrong."""

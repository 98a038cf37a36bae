"""What people start, pause, change and watch: a simulated run, or a bench."""

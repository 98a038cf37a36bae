"""Sessions: a simulated run, or a bench, that users start, pause, change and watch."""

"""The session: settings, references, loads, design and recording."""

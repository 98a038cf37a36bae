"""The 3D view of a session: viser servers and the proxy to them."""

"""The commands `svsa serve`, `svsa excite` and `svsa openapi`."""

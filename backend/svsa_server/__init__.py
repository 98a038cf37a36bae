"""The lab's server: REST, streams, the page and the 3D view over the library `svsa`."""

"""`svsa serve`, `excite`, `openapi`: what is started from the shell."""

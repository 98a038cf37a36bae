"""`python -m svsa`: the command `svsa`, where its script is not on the path."""

from svsa.cli import main

main()

"""Tests of validation/: `python3 -m unittest discover -t . -s validation/tests`, from the root of the repository."""

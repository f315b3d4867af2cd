"""Planar impacts of an ellipse, from a data set that a user has (README.md)."""

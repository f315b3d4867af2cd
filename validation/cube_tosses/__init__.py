"""Tosses of an acrylic cube: four engines against 550 measured paths (README.md)."""

"""Adapters of engines; an engine whose package is missing is told when it is used."""

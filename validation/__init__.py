"""Pong and other engines against published measurements (README.md)."""

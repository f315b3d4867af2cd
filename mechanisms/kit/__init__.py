"""Shared parts of the mechanisms: MuJoCo moves the bodies, Pong's plugin computes their contacts (docs/mujoco.md)."""

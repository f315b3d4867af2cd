"""What the mechanisms share: MuJoCo moves the bodies, Pong's plugin touches them (docs/mujoco.md)."""

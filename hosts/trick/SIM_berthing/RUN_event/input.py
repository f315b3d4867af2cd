# The thruster is cut when the first foot touches. Level and without turning, the payload falls 6 mm: the touch is at
# (sqrt(v^2 + 2 a s) - v)/a = 0.09367499 s with v = 0.05 m/s, a = 150 N / 500 kg and s = 0.006 m.
dyn.berthing.cut_at_touch = 1
dyn.berthing.payload.orientation = [1.0, 0.0, 0.0, 0.0]
dyn.berthing.payload.angular_velocity = [0.0, 0.0, 0.0]
trick.stop(0.5)

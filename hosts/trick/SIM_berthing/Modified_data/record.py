# Motion of both bodies, in full precision, every 10 ms.
recording = trick.DRAscii("motion")
recording.set_cycle(0.01)
for body in ("payload", "platform"):
    for name, count in (("position", 3), ("orientation", 4), ("linear_velocity", 3), ("angular_velocity", 3)):
        for index in range(count):
            recording.add_variable("dyn.berthing." + body + "." + name + "[" + str(index) + "]")
recording.thisown = 0
trick.add_data_record_group(recording)

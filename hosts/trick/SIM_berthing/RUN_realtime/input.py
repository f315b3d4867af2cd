# In real time, with a worker. Trick waits for the clock at the end of every software frame: here after ten steps.
dyn.berthing.contact.workers = 1

trick.real_time_enable()
trick.exec_set_software_frame(0.01)
trick.itimer_enable()               # sleep before a frame instead of spinning

trick.exec_set_enable_freeze(True)  # freeze_init lets the worker sleep, unfreeze wakes it
trick.stop(10.0)

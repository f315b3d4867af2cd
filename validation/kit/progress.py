"""One line of progress on the terminal, which is written over, or nothing where the output goes to a file."""

import sys
import time


class Progress:
    """Counts parts of a task, and estimates the time that is left."""

    def __init__(self, title, total, stream=sys.stderr):
        self.title, self.total, self.stream = title, total, stream
        self.done, self.began, self.shown = 0, time.monotonic(), 0.0

    def advance(self, note=""):
        """Counts one more part."""
        self.done += 1
        now = time.monotonic()
        if not self.stream.isatty() or (now - self.shown < 0.2 and self.done < self.total):
            return
        self.shown = now
        left = (now - self.began) / self.done * (self.total - self.done)
        self.stream.write(f"\r\033[K{self.title}: {self.done} of {self.total}, {left:.0f} s left {note}")
        self.stream.flush()

    def close(self):
        """Clears the line; returns the seconds since the start."""
        if self.stream.isatty():
            self.stream.write("\r\033[K")
        return time.monotonic() - self.began

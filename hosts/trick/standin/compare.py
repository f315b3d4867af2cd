"""Compares a run of SIM_berthing with the same scene under `pong run`: compare.py log_motion.csv states.csv TOLERANCE.

Both record time, then for each body position, orientation, velocity and angular velocity of its group frame.
"""

import csv
import sys


def reference(path):
    """Time, to the microsecond, to the numbers of all bodies in turn."""
    rows = {}
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            numbers = [float(value) for name, value in row.items() if name not in ("time_s", "body")]
            rows.setdefault(round(float(row["time_s"]) * 1e6), []).extend(numbers)
    return rows


def main():
    log, states, tolerance = sys.argv[1], sys.argv[2], float(sys.argv[3])
    expected, worst, compared = reference(states), (0.0, 0, 0.0), 0
    with open(log, newline="") as file:
        for time, *numbers in (map(float, row) for row in csv.reader(file)):
            wanted = expected[round(time * 1e6)]
            if len(wanted) != len(numbers):
                sys.exit(f"{log}: {len(numbers)} numbers, {states} has {len(wanted)}")
            worst = max(worst, *((abs(a - b), column, time) for column, (a, b) in enumerate(zip(numbers, wanted))))
            compared += 1
    print(f"{compared} records, largest difference {worst[0]:.1e} (column {worst[1]}, {worst[2]} s)")
    sys.exit(0 if compared == 301 and worst[0] < tolerance else 1)


main()

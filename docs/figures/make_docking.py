"""Draws the history of one docking as SVG. Run from the root of the repository:

    bash c_examples/run docking --fast --case fast,x+,roll+,pitch- --seconds 20 --csv docking.csv
    python3 docs/figures/make_docking.py docking.csv
"""

import csv
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
WIDTH, PANEL, LEFT, RIGHT, TOP = 860, 120, 70, 20, 34
PANELS = [
    ("ring to ring, mm", [("gap_m", 1e3, "#2471a3", "gap"), ("lateral_m", 1e3, "#c0392b", "lateral")]),
    ("misalignment, degrees", [("tilt_deg", 1, "#2471a3", "tilt"), ("roll_deg", 1, "#c0392b", "roll")]),
    ("attenuation, N", [("attenuation_force_n", 1, "#2471a3", "force in the ring's attenuators")]),
    ("closing speed, mm/s", [("closing_m_s", 1e3, "#2471a3", "of the vehicles")]),
]
SEAM = "#888"


def polyline(points, color):
    text = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    return f'<polyline points="{text}" fill="none" stroke="{color}" stroke-width="1.6"/>'


def label(x, y, text, color="#222", anchor="start", size=12):
    return f'<text x="{x:.1f}" y="{y:.1f}" fill="{color}" text-anchor="{anchor}" font-family="sans-serif" font-size="{size}">{text}</text>'


def panel(rows, times, index, title, curves):
    top = TOP + index * (PANEL + 24)
    values = [[float(row[name]) * scale for row in rows] for name, scale, _, _ in curves]
    low, high = min(0.0, *map(min, values)), max(map(max, values))
    span = (high - low) or 1.0
    x = lambda t: LEFT + (WIDTH - LEFT - RIGHT) * t / times[-1]
    y = lambda v: top + PANEL * (1 - (v - low) / span)
    parts = [
        f'<rect x="{LEFT}" y="{top}" width="{WIDTH - LEFT - RIGHT}" height="{PANEL}" fill="#faf9f6" stroke="#ccc"/>',
        label(LEFT, top - 6, title),
        label(LEFT - 6, top + 10, f"{high:.0f}", anchor="end"),
        label(LEFT - 6, top + PANEL, f"{low:.0f}", anchor="end"),
    ]
    name_at = WIDTH - RIGHT
    for (_, _, color, name), series in reversed(list(zip(curves, values))):
        parts.append(polyline([(x(t), y(v)) for t, v in zip(times, series)], color))
        parts.append(label(name_at, top - 6, name, color, "end"))
        name_at -= 8 * len(name) + 16
    return parts, x


def main():
    with open(sys.argv[1], newline="") as file:
        rows = list(csv.DictReader(file))[::5]
    times = [float(row["time_s"]) for row in rows]
    height = TOP + len(PANELS) * (PANEL + 24) + 10
    parts = []
    for index, (title, curves) in enumerate(PANELS):
        drawn, x = panel(rows, times, index, title, curves)
        parts += drawn
    bottom = height - 34
    snapped = [next(t for t, row in zip(times, rows) if float(row["gap_m"]) < 1.6e-3)]
    touched = [next(t for t, row in zip(times, rows) if int(row["contacts"]) > 0)]
    for moment, name in [(touched[0], "first contact"), (snapped[0], "soft capture")]:
        parts.append(f'<line x1="{x(moment):.1f}" y1="{TOP}" x2="{x(moment):.1f}" y2="{bottom}" stroke="{SEAM}" stroke-dasharray="4 4"/>')
        parts.append(label(x(moment) + 4, TOP + 14, name, SEAM))
    for tick in range(0, int(times[-1]) + 1, 5):
        parts.append(label(x(tick), height - 12, f"{tick} s", anchor="middle"))
    body = "\n".join(parts)
    (HERE / "docking.svg").write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" width="{WIDTH}" height="{height}">\n'
        f'<rect width="100%" height="100%" fill="white"/>\n{body}\n</svg>\n'
    )


main()

"""Draws the figures of the theory manual as SVG. Run: python3 docs/figures/make_figures.py"""

import math
import pathlib

HERE = pathlib.Path(__file__).resolve().parent
INK, SOFT, RED, BLUE, SOLID = "#222", "#888", "#c0392b", "#2471a3", "#e8e4da"


class Drawing:
    """An SVG with y upwards, in user units of one pixel."""

    def __init__(self, width, height):
        self.width, self.height, self.parts = width, height, []

    def at(self, x, y):
        return f"{x:.1f},{self.height - y:.1f}"

    def polygon(self, points, fill=SOLID, stroke=INK):
        text = " ".join(self.at(*p) for p in points)
        self.parts.append(f'<polygon points="{text}" fill="{fill}" stroke="{stroke}" stroke-width="1.5"/>')

    def line(self, a, b, color=INK, width=1.5, dash=None):
        (x1, y1), (x2, y2) = a, b
        dashes = f' stroke-dasharray="{dash}"' if dash else ""
        self.parts.append(
            f'<line x1="{x1:.1f}" y1="{self.height - y1:.1f}" x2="{x2:.1f}" y2="{self.height - y2:.1f}" '
            f'stroke="{color}" stroke-width="{width}"{dashes}/>'
        )

    def arrow(self, a, b, color=RED, width=2.5):
        self.line(a, b, color, width)
        angle = math.atan2(b[1] - a[1], b[0] - a[0])
        wings = [(b[0] - 10 * math.cos(angle + t), b[1] - 10 * math.sin(angle + t)) for t in (0.4, -0.4)]
        self.polygon([b, *wings], fill=color, stroke=color)

    def circle(self, center, radius, fill="none", stroke=INK, dash=None):
        x, y = center
        dashes = f' stroke-dasharray="{dash}"' if dash else ""
        self.parts.append(
            f'<circle cx="{x:.1f}" cy="{self.height - y:.1f}" r="{radius}" fill="{fill}" stroke="{stroke}" '
            f'stroke-width="1.5"{dashes}/>'
        )

    def text(self, position, text, color=INK, anchor="start"):
        x, y = position
        self.parts.append(
            f'<text x="{x:.1f}" y="{self.height - y:.1f}" fill="{color}" text-anchor="{anchor}" '
            f'font-family="sans-serif" font-size="13">{text}</text>'
        )

    def save(self, name):
        body = "\n".join(self.parts)
        (HERE / name).write_text(
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {self.width} {self.height}" '
            f'width="{self.width}" height="{self.height}">\n<rect width="100%" height="100%" fill="white"/>\n{body}\n</svg>\n'
        )


def load_sharing():
    d = Drawing(660, 230)
    for left, angle, title in [(20, 0, "one plate: one spring"), (240, 30, "in between"), (460, 90, "square corner: two springs")]:
        t = math.radians(angle)
        corner = (left + 90, 60)
        far = (corner[0] + 90 * math.cos(t), corner[1] + 90 * math.sin(t))
        d.line((left, 60), corner, INK, 3)
        d.line(corner, far, INK, 3)
        # A sphere with depth δ at both walls.
        radius, depth = 48, 10
        normal = (-math.sin(t), math.cos(t))
        height = radius - depth
        along = math.tan(t / 2) * height if angle else 0
        center = (corner[0] - along, corner[1] + height)
        d.circle(center, radius, stroke=BLUE)
        d.arrow((center[0], 60), (center[0], 60 + 40))
        if angle:
            foot = (center[0] - normal[0] * height, center[1] - normal[1] * height)
            d.arrow(foot, (foot[0] + 40 * normal[0], foot[1] + 40 * normal[1]))
        d.text((left, 20), title)
        share = 1 / (1 + math.cos(t))
        d.text((left, 205), f"w = {share:.2f} each" if angle else "w₁ + w₂ = 1")
    d.save("load_sharing.svg")


def line_segment():
    d = Drawing(660, 220)
    d.polygon([(180, 20), (480, 20), (480, 110), (180, 110)])
    a, b = (30, 118), (600, 60)
    d.line(a, b, BLUE, 3)
    slope = (b[1] - a[1]) / (b[0] - a[0])
    length = math.hypot(1, slope)
    up = (-slope / length, 1 / length)
    for edge, name in [((180, 110), "δ₁"), ((480, 110), "δ₂")]:
        below = (edge[1] - (a[1] + slope * (edge[0] - a[0]))) / length
        foot = (edge[0] - up[0] * below, edge[1] - up[1] * below)
        d.arrow(foot, (foot[0] + 60 * up[0], foot[1] + 60 * up[1]))
        d.text((edge[0] + 8, edge[1] + 8), name, RED)
    d.circle(a, 4, fill=BLUE, stroke=BLUE)
    d.circle(b, 4, fill=BLUE, stroke=BLUE)
    d.line((20, 110), (640, 110), SOFT, 1, "4 4")
    d.text((20, 190), "Each end inside the solid carries half a spring under the top face. The left endpoint lies above the")
    d.text((20, 172), "plane of the top, but the segment leaves through the left side: the right side must not push.")
    d.save("line_segment.svg")


def bristle():
    d = Drawing(420, 300)
    center, static, kinetic = (150, 140), 120, 85
    d.circle(center, static, stroke=SOFT, dash="5 4")
    d.circle(center, kinetic, stroke=INK)
    at = lambda angle, radius: (center[0] + radius * math.cos(angle), center[1] + radius * math.sin(angle))
    # A path of 1.6 p_k along x turns the bristle from 100° by tan(ψ/2) = tan(ψ₀/2)·exp(−z).
    before, way = math.radians(75), 1.6
    after = 2 * math.atan(math.tan(before / 2) * math.exp(-way))
    carried, held = at(before, kinetic), at(after, kinetic)
    trial = (carried[0] + way * kinetic, carried[1])
    d.line(center, carried, SOFT, 2)
    d.line(carried, trial, SOFT, 1.5, "3 3")
    for step in range(12):
        angles = [before + (after - before) * (step + part) / 12 for part in (0, 1)]
        d.line(at(angles[0], kinetic), at(angles[1], kinetic), BLUE, 3)
    d.arrow(center, held, BLUE)
    d.arrow(held, at(after, kinetic - 60))
    d.circle(carried, 4, fill=SOFT, stroke=SOFT)
    d.circle(trial, 4, fill=INK)
    d.text((trial[0] - 70, trial[1] + 12), "p* = carried p + u")
    d.text((center[0] - 20, center[1] + 40), "carried p", SOFT, anchor="end")
    d.text((held[0] + 8, held[1] - 4), "p", BLUE)
    d.text((center[0] + 2, center[1] - 100), "p_k = μ_k F_n/K", anchor="middle")
    d.text((center[0] + 2, center[1] + 126), "p_s = μ_s F_n/K", SOFT, anchor="middle")
    d.text((center[0] + 4, center[1] - 24), "F_t = −K p", RED)
    d.save("bristle.svg")


def entry():
    d = Drawing(520, 230)
    d.polygon([(60, 30), (140, 30), (140, 180), (60, 180)])
    places = [(40, 150), (85, 140), (125, 128)]
    for a, b in zip(places, places[1:]):
        d.line(a, b, SOFT, 1.5, "4 3")
    for p in places:
        d.circle(p, 3, fill=INK)
    d.arrow(places[2], (places[2][0] - 65, places[2][1]))
    d.text((20, 200), "remembered face: pushed back to the left")
    n = 16
    rim = [(400 + 80 * math.cos(2 * math.pi * (i + 0.5) / n), 100 + 80 * math.sin(2 * math.pi * (i + 0.5) / n)) for i in range(n)]
    d.polygon(rim)
    for k in (4, 3, 2, 1, 0):
        angle = 2 * math.pi * k / n
        p = (400 + 62 * math.cos(angle), 100 + 62 * math.sin(angle))
        d.circle(p, 3, fill=INK)
        if k in (4, 0):
            d.arrow(p, (p[0] + 40 * math.cos(angle), p[1] + 40 * math.sin(angle)))
    d.text((310, 200), "the face follows the curve")
    d.save("entry.svg")


for figure in (load_sharing, line_segment, bristle, entry):
    figure()

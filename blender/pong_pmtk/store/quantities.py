# SPDX-License-Identifier: GPL-3.0-or-later
"""Physical quantities as shown and read by the panels: a number with its unit, in full precision.

Blender's number fields know no newtons, show a fixed count of decimals (0.25 mm becomes 0.0003) and keep 32 bits. So
panels show quantities as text: `2.5e5 N/m`, `0.25 mm`. What is typed may have any unit of the same dimension, or none,
which means SI.
"""

import sys

import bpy

# SI unit -> units of that dimension, with their factors to SI.
UNITS = {
    "": {},
    "m": {"m": 1.0, "km": 1e3, "cm": 1e-2, "mm": 1e-3, "µm": 1e-6, "μm": 1e-6, "um": 1e-6},
    "m/s": {"m/s": 1.0, "cm/s": 1e-2, "mm/s": 1e-3},
    "kg": {"kg": 1.0, "g": 1e-3, "t": 1e3},
    "s/m": {"s/m": 1.0},
    "N/m": {"N/m": 1.0, "kN/m": 1e3, "MN/m": 1e6, "N/mm": 1e3, "kN/mm": 1e6},
    "m^2": {"m^2": 1.0, "m²": 1.0, "cm^2": 1e-4, "cm²": 1e-4, "mm^2": 1e-6, "mm²": 1e-6},
    "N/m^3": {"N/m^3": 1.0, "N/m³": 1.0, "N/mm^3": 1e9, "N/mm³": 1e9, "Pa/m": 1.0, "MPa/m": 1e6, "MPa/mm": 1e9, "GPa/m": 1e9},
    "N/m^1.5": {"N/m^1.5": 1.0, "kN/m^1.5": 1e3, "MN/m^1.5": 1e6},
    "N·s/m": {"N·s/m": 1.0, "N*s/m": 1.0, "Ns/m": 1.0, "kN·s/m": 1e3, "kN*s/m": 1e3, "N·s/mm": 1e3, "N*s/mm": 1e3},
}
LENGTHS = (("m", 1.0, 0.1), ("mm", 1e-3, 1e-5), ("µm", 1e-6, 0.0))  # unit, in metres, from how many metres on it is taken
DIGITS = 12  # enough for what anybody types; a double has 15 to 17
PLAIN = (1e-3, 1e5)  # numbers within are written without an exponent


def shown(value, unit):
    """A quantity in SI as text."""
    if unit == "m" and value != 0.0:
        unit, factor = next((name, metres) for name, metres, least in LENGTHS if abs(value) >= least)
        value /= factor
    return f"{number(value)} {unit}".rstrip()


def number(value):
    """Shortest text of a number, of at most DIGITS digits."""
    value = float(f"{value:.{DIGITS}g}")
    if value == 0.0 or PLAIN[0] <= abs(value) < PLAIN[1] or value - value != 0.0:
        return f"{value:.{DIGITS}g}"
    mantissa, exponent = f"{value:.{DIGITS - 1}e}".split("e")
    return f"{mantissa.rstrip('0').rstrip('.')}e{int(exponent)}"


def parsed(text, unit):
    """Value in SI of typed text. Raises `ValueError` with the valid forms."""
    text = text.strip().replace(" ", "").replace("**", "^")
    end = len(text)
    while end:
        try:
            value = float(text[:end])
            break
        except ValueError:
            end -= 1
    else:
        raise ValueError(f'"{text}" does not begin with a number')
    written = text[end:]
    units = UNITS.get(unit, {unit: 1.0})  # of a power of the depth there is only the one in SI
    if written and written not in units:
        known = ", ".join(units)
        raise ValueError(f'"{written}" is no unit of this field: ' + (f"write one of {known}" if known else "it has none"))
    if value != value:
        raise ValueError("a number is wanted, not nan")
    return value * units[written] if written else value


def refuse(reason):
    """Reports why typed text is refused; the field shows its old value again."""
    if bpy.app.background:
        print(f"Not changed: {reason}", file=sys.stderr)
        return
    bpy.context.window_manager.popup_menu(
        lambda self, _context: self.layout.label(text=reason), title="Not Changed", icon="ERROR")


def view(get, set_, unit, least=None, most=None, **options):
    """A StringProperty that shows the number of `get(self)` with its unit (or that of `unit(self)`)."""
    unit_of = unit if callable(unit) else lambda _self: unit

    def read(self):
        return shown(get(self), unit_of(self))

    def write(self, text):
        try:
            value = parsed(text, unit_of(self))
            if least is not None and value < least or most is not None and value > most:
                raise ValueError(f"{text.strip()}: from {least:g}" + (f" to {most:g}" if most is not None else " on"))
        except ValueError as reason:
            refuse(str(reason))
            return
        set_(self, value)

    return bpy.props.StringProperty(get=read, set=write, **options)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Quantities as text with units."""

import contextlib
import io
import math

from pong_pmtk.store import quantities

from .scenes import InBlender, root


class Texts(InBlender):
    def test_what_is_shown(self):
        for value, unit, text in (
            (0.00025, "m", "0.25 mm"), (2.5e-7, "m", "0.25 µm"), (0.1, "m", "0.1 m"), (12.5, "m", "12.5 m"), (0.0, "m", "0 m"),
            (-0.002, "m", "-2 mm"), (1e6, "N/m", "1e6 N/m"), (2.5e5, "N/m", "2.5e5 N/m"), (1234.5, "N/m", "1234.5 N/m"),
            (1e5 + 0.5, "N/m", "1.000005e5 N/m"), (math.inf, "N/m", "inf N/m"), (0.0005, "N·s/m", "5e-4 N·s/m"),
            (0.3, "", "0.3"), (0.30000000000000004, "", "0.3"), (9.9999999999999e4, "kg", "1e5 kg"),
        ):
            self.assertEqual(quantities.shown(value, unit), text)

    def test_what_is_typed(self):
        for text, unit, value in (
            ("0.25 mm", "m", 0.25e-3), (".25mm", "m", 0.25e-3), ("1e-3", "m", 1e-3), ("3 µm", "m", 3e-6), ("2", "m", 2.0),
            ("2.5e5 N/m", "N/m", 2.5e5), ("250 kN/m", "N/m", 2.5e5), ("1 N/mm", "N/m", 1e3), ("20 N*s/m", "N·s/m", 20.0),
            ("5 g", "kg", 5e-3), ("inf", "N/m", math.inf), (" 1 ", "", 1.0),
        ):
            self.assertAlmostEqual(quantities.parsed(text, unit) / value if math.isfinite(value) else 1.0, 1.0, places=14)

    def test_what_is_shown_can_be_typed(self):
        for unit in quantities.UNITS:
            for value in (1.0 / 3.0, 7e-9, 1e-4, 0.05, 99999.0, 1e5, 2.0**40):
                again = quantities.parsed(quantities.shown(value, unit), unit)
                self.assertAlmostEqual(again / value, 1.0, places=11)

    def test_what_cannot_be_meant_is_refused_with_what_can(self):
        for text, unit, reason in (("1 mm", "N/m", "write one of N/m"), ("soft", "N/m", "begin with a number"),
                                   ("", "m", "begin with a number"), ("0.3 m", "", "it has none"), ("nan", "m", "nan")):
            with self.assertRaisesRegex(ValueError, reason):
                quantities.parsed(text, unit)


class Fields(InBlender):
    def test_a_surface_is_set_by_text_in_full_precision(self):
        surface = root().pong_model.surfaces[0]
        surface.stiffness_text = "123.456789012 kN/m"
        self.assertIn("123456.789012", surface.spec)
        self.assertAlmostEqual(surface.stiffness, 123456.789012, delta=0.01)
        surface.stiffness_text = "inf"
        self.assertTrue(surface.rigid)
        surface.rigid = False
        surface.normal, surface.use_ramp = "Linear", True
        surface.ramp_text = "0.25 mm"
        self.assertEqual(surface.ramp_text, "0.25 mm")
        surface.normal = "HuntCrossley"
        surface.exponent = "HERTZ"
        self.assertEqual(surface.stiffness_text, "1e6 N/m^1.5")
        surface.normal = "PowerLaw"
        surface.damping_text = "4e7 N·s/m^2"
        self.assertEqual((surface.damping, surface.damping_text), (4e7, "4e7 N·s/m^2"))
        surface.damping_exponent = 0.5
        self.assertEqual(surface.damping_text, "4e7 N·s/m^1.5")
        surface.use_restitution = True
        self.assertEqual((surface.speed_text, surface.mass_text), ("0.1 m/s", "1 kg"))

    def test_what_is_out_of_range_changes_nothing(self):
        surface = root().pong_model.surfaces[0]
        surface.normal, surface.use_restitution = "Linear", True
        before = surface.spec
        for name, text in (("restitution_text", "1.5"), ("mass_text", "-1 kg"), ("stiffness_text", "1 m")):
            told = io.StringIO()
            with contextlib.redirect_stderr(told):
                setattr(surface, name, text)
            self.assertIn("Not changed", told.getvalue())
            self.assertEqual(surface.spec, before)

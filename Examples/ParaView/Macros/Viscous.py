"""Macro: applies the preset "viscous" to the selected Active Implicit Surface."""

from active_implicit_surfaces import paraview_presets

paraview_presets.apply("viscous")

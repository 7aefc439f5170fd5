"""Macro: applies the preset "paper" to the selected Active Implicit Surface."""

from active_implicit_surfaces import paraview_presets

paraview_presets.apply("paper")

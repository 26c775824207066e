# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""The hopper's wall stress in ParaView, of the last step: paraview --script=view.py

In the folder of the run. With pvpython it writes wall_stress.png and ends.
"""
import glob
import re

from paraview.simple import (CreateView, ColorBy, GetColorTransferFunction, GetScalarBar, Render, ResetCamera,
                             SaveScreenshot, Show, XMLPolyDataReader)


def last(pattern):
    return max(glob.glob(pattern), key=lambda name: int(re.findall(r"\d+", name)[-1]))


view = CreateView("RenderView")
view.ViewSize = [700, 700]
view.Background = [1, 1, 1]
view.UseColorPaletteForBackground = 0
view.OrientationAxesVisibility = 0
wall = XMLPolyDataReader(FileName=[last("hopper_*.vtp")])
shown = Show(wall, view)
shown.SetRepresentationType("Surface With Edges")
ColorBy(shown, ("CELLS", "normal_stress"))
shown.Ambient, shown.Diffuse = 0.5, 0.5
shown.EdgeColor = [0.6, 0.6, 0.6]
shown.LineWidth = 0.5
colours = GetColorTransferFunction("normal_stress")
colours.ApplyPreset("Viridis (matplotlib)", True)
shown.RescaleTransferFunctionToDataRange(False)
shown.SetScalarBarVisibility(view, True)
bar = GetScalarBar(colours, view)
bar.Title, bar.ComponentTitle = "normal stress, Pa", ""    # the hopper is 100 mm across
bar.AutomaticLabelFormat, bar.LabelFormat, bar.RangeLabelFormat = 0, "%.0f", "%.0f"
bar.ScalarBarLength, bar.ScalarBarThickness, bar.WindowLocation = 0.5, 24, "Lower Right Corner"
bar.TitleColor = bar.LabelColor = [0, 0, 0]
bar.TitleFontSize = bar.LabelFontSize = 26
view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [0.25, -0.35, -0.1], [0, 0, 0.06], [0, 0, 1]
ResetCamera(view)
Render(view)
SaveScreenshot("wall_stress.png", view)

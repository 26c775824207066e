# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""The wall stress of the hopper's cone in ParaView, of the last step: paraview --script=view.py

In the folder of the run. With pvpython it writes wall_stress.png and ends.
"""
import glob
import re

from paraview.simple import (Clip, CreateView, ColorBy, GetColorTransferFunction, GetScalarBar, Render, ResetCamera,
                             SaveScreenshot, Show, Text, XMLPolyDataReader, servermanager)

TIMESTEP = 1e-5


def step(name):
    return int(re.findall(r"\d+", name)[-1])


view = CreateView("RenderView")
view.ViewSize = [760, 480]
view.Background = [1, 1, 1]
view.UseColorPaletteForBackground = 0
view.OrientationAxesVisibility = 0
last = max(glob.glob("hopper_*.vtp"), key=step)
wall = XMLPolyDataReader(FileName=[last])
# The grains lie in the cone. The facets above it have no load.
cone = Clip(Input=wall, ClipType="Plane", Invert=1, Crinkleclip=1)
cone.ClipType.Origin, cone.ClipType.Normal = [0, 0, 0.059], [0, 0, 1]
shown = Show(cone, view)
shown.SetRepresentationType("Surface With Edges")
ColorBy(shown, ("CELLS", "normal_stress"))
shown.Ambient, shown.Diffuse = 0.5, 0.5
shown.EdgeColor = [0.6, 0.6, 0.6]
shown.LineWidth = 0.5
colours = GetColorTransferFunction("normal_stress")
colours.ApplyPreset("Viridis (matplotlib)", True)
# The range is that of 95 of 100 loaded facets: a single one may have much more.
loads = servermanager.Fetch(cone).GetCellData().GetArray("normal_stress")
loads = sorted(filter(None, (loads.GetValue(k) for k in range(loads.GetNumberOfTuples()))))
colours.RescaleTransferFunction(0, float(f"{loads[int(0.95 * len(loads))]:.1g}") if loads else 1)
shown.SetScalarBarVisibility(view, True)
bar = GetScalarBar(colours, view)
bar.Title, bar.ComponentTitle = "normal stress, Pa", ""
bar.AutomaticLabelFormat, bar.LabelFormat, bar.RangeLabelFormat = 0, "%.0f", "%.0f"
bar.ScalarBarLength, bar.ScalarBarThickness, bar.WindowLocation = 0.8, 24, "Lower Right Corner"
bar.TitleColor = bar.LabelColor = [0, 0, 0]
bar.TitleFontSize = bar.LabelFontSize = 24
text = Show(Text(Text=f"100 mm across at the top\nt = {step(last) * TIMESTEP:.2f} s"), view)
text.Color, text.FontSize, text.WindowLocation, text.Justification = [0, 0, 0], 24, "Upper Left Corner", "Left"
view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [0.13, -0.2, -0.1], [0, 0, 0.03], [0, 0, 1]
ResetCamera(view)
view.CameraViewAngle = 24    # nearer than ResetCamera
Render(view)
SaveScreenshot("wall_stress.png", view)

# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Grains and two meshes, each in its colour: xvfb-run -a -s -noreset pvpython look.py"""
from paraview.simple import *

view = CreateView("RenderView")
view.ViewSize = [800, 900]
view.Background = [1, 1, 1]
view.UseColorPaletteForBackground = 0
for name, colour, opacity in (("wall_hopper.stl", [0.7, 0.7, 0.75], 0.3), ("wall_blade_55000.stl", [0.8, 0.2, 0.1], 1)):
    shown = Show(STLReader(FileNames=[name]), view)
    shown.DiffuseColor, shown.AmbientColor, shown.Opacity = colour, colour, opacity
lines = open("grains_55000.dump").read().split("\n")
with open("grains.csv", "w") as table:    # what stands behind "ITEM: ATOMS" are the columns
    table.write("\n".join([lines[8].replace("ITEM: ATOMS ", "").strip().replace(" ", ",")] +
                          [line.strip().replace(" ", ",") for line in lines[9:] if line.strip()]))
points = TableToPoints(Input=CSVReader(FileName=["grains.csv"]), XColumn="x", YColumn="y", ZColumn="z")
grains = Glyph(Input=points, GlyphType="Sphere", ScaleArray=["POINTS", "radius"], ScaleFactor=2, GlyphMode="All Points")
shown = Show(grains, view)
shown.DiffuseColor = shown.AmbientColor = [0.9, 0.6, 0.2]
shown.ColorArrayName = ["POINTS", ""]
view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [0.1, -0.35, 0.15], [0, 0, 0.04], [0, 0, 1]
Render(view)
SaveScreenshot("look.png", view)

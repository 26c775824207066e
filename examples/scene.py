# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Draw spheres and meshes with VTK, and put a scale bar, the time and a colour key below them.

Needs VTK (Debian's python3-paraview or python3-vtk9), a display, which xvfb-run makes, and PIL.
"""
import math

import numpy as np
from PIL import Image, ImageDraw, ImageFont
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPlane, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkClipPolyData, vtkFeatureEdges, vtkPolyDataNormals
from vtkmodules.vtkIOGeometry import vtkSTLReader
from vtkmodules.vtkRenderingCore import (vtkActor, vtkLight, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow,
                                         vtkWindowToImageFilter)
from vtkmodules.vtkRenderingOpenGL2 import vtkOpenGLSphereMapper

SHARP = 35    # degrees: a fold that is drawn as an edge; flatter ones are shaded as a smooth surface
FINER = 2     # a pixel is the mean of so many by so many
FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"
TEXT = 27     # pixels: read at half of a width of 640
INK = (30, 30, 30)
MARGIN = 12    # pixels
EDGE = 10    # pixels that bar, key and time stay clear of the left and right edge

# Okabe and Ito: told apart by every kind of colour vision.
ORANGE, BLUE, SKY, GREEN, YELLOW, VERMILION = ("#E69F00", "#0072B2", "#56B4E9", "#009E73", "#F0E442", "#D55E00")
STEEL, DARK = "#B8BDC4", "#50555C"
# viridis, in nine steps.
VIRIDIS = np.array([(68, 1, 84), (71, 44, 122), (59, 81, 139), (44, 113, 142), (33, 144, 141), (39, 173, 129), (92, 200, 99),
                    (170, 220, 50), (253, 231, 37)]) / 255


def rgb(colour):
    return tuple(int(colour[k:k + 2], 16) / 255 for k in (1, 3, 5))


def viridis(share):
    """Colours of numbers from 0 to 1, which are cut off beyond."""
    at = np.clip(np.asarray(share, float), 0, 1) * (len(VIRIDIS) - 1)
    low = np.minimum(at.astype(int), len(VIRIDIS) - 2)
    return VIRIDIS[low] + (at - low)[..., None] * (VIRIDIS[low + 1] - VIRIDIS[low])


def read_atoms(path):
    """Columns by name, of the last frame of a dump of style custom."""
    lines = path.read_text().rsplit("ITEM: ATOMS ", 1)[1].split("\n")
    rows = np.array([line.split() for line in lines[1:] if line.strip()], float)
    return dict(zip(lines[0].split(), rows.T))


def spheres(centres, radii, colours):
    data, points, cells = vtkPolyData(), vtkPoints(), vtkCellArray()
    count = len(radii)
    points.SetData(numpy_to_vtk(np.ascontiguousarray(centres, np.float32), deep=1))
    data.SetPoints(points)
    ids = np.stack([np.ones(count, np.int64), np.arange(count)], axis=1)
    cells.SetCells(count, numpy_to_vtkIdTypeArray(ids.ravel(), deep=1))
    data.SetVerts(cells)
    size = numpy_to_vtk(np.ascontiguousarray(radii, np.float32), deep=1)
    size.SetName("radius")
    data.GetPointData().AddArray(size)
    data.GetPointData().SetScalars(numpy_to_vtk(np.ascontiguousarray(np.asarray(colours) * 255, np.uint8), deep=1))
    mapper = vtkOpenGLSphereMapper()
    mapper.SetInputData(data)
    mapper.SetScaleArray("radius")
    return [actor(mapper, ambient=0.25, diffuse=0.8, specular=0.25)]


def mesh(path, colour=STEEL, opacity=1.0, cut=None, shift=(0, 0, 0)):
    """Its surface, smooth but for sharp folds, and these folds and its rims as lines; `cut` is a point and a normal
    that points into what is left."""
    reader, clean = vtkSTLReader(), vtkCleanPolyData()
    reader.SetFileName(str(path))
    clean.SetInputConnection(reader.GetOutputPort())
    source = clean
    if cut:
        plane, clip = vtkPlane(), vtkClipPolyData()
        plane.SetOrigin(cut[0])
        plane.SetNormal(cut[1])
        clip.SetInputConnection(source.GetOutputPort())
        clip.SetClipFunction(plane)
        source = clip
    # An edge between triangles that are wound in opposite ways is no fold.
    alike, normals, edges = vtkPolyDataNormals(), vtkPolyDataNormals(), vtkFeatureEdges()
    alike.SplittingOff()
    alike.SetInputConnection(source.GetOutputPort())
    normals.SetFeatureAngle(SHARP)
    edges.SetFeatureAngle(SHARP)
    edges.ColoringOff()
    mappers = []
    for stage in (normals, edges):
        stage.SetInputConnection(alike.GetOutputPort())
        mapper = vtkPolyDataMapper()
        mapper.SetInputConnection(stage.GetOutputPort())
        mapper.ScalarVisibilityOff()
        mappers.append(mapper)
    surface, lines = actor(mappers[0], ambient=0.3, diffuse=0.7, specular=0.1), actor(mappers[1])
    surface.GetProperty().SetColor(rgb(colour))
    surface.GetProperty().SetOpacity(opacity)
    lines.GetProperty().SetColor(rgb(DARK))
    lines.GetProperty().SetLineWidth(1.2 * FINER)
    lines.GetProperty().LightingOff()
    for one in (surface, lines):
        one.SetPosition(*shift)
    return [surface, lines]


def actor(mapper, ambient=1.0, diffuse=0.0, specular=0.0):
    made = vtkActor()
    made.SetMapper(mapper)
    look = made.GetProperty()
    look.SetAmbient(ambient)
    look.SetDiffuse(diffuse)
    look.SetSpecular(specular)
    look.SetSpecularPower(30)
    return made


class Camera:
    """Looks along a direction as `view` of dump image has it, without perspective, at a box of the scene."""

    def __init__(self, view, box, width):
        theta, phi = map(math.radians, view)
        self.back = np.array([math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi), math.cos(theta)])
        self.right = np.cross((0, 0, 1), self.back)
        self.right /= np.linalg.norm(self.right)
        self.up = np.cross(self.back, self.right)
        box = np.asarray(box, float).reshape(3, 2)
        self.centre = box.mean(axis=1)
        corners = np.array(np.meshgrid(*box)).reshape(3, -1).T - self.centre
        across, high = (2.04 * np.abs(corners @ axis).max() for axis in (self.right, self.up))
        self.scale = width / across    # pixels a length
        self.size = width, int(round(high * self.scale))
        self.far = np.linalg.norm(box[:, 1] - box[:, 0])

    def pixel(self, point):
        away = np.asarray(point, float) - self.centre
        return (self.size[0] / 2 + self.scale * (away @ self.right), self.size[1] / 2 - self.scale * (away @ self.up))

    def draw(self, actors):
        renderer, window, grab = vtkRenderer(), vtkRenderWindow(), vtkWindowToImageFilter()
        window.SetOffScreenRendering(1)
        window.SetSize(*(FINER * n for n in self.size))
        window.SetMultiSamples(0)
        window.SetAlphaBitPlanes(1)
        window.AddRenderer(renderer)
        renderer.SetBackground(1, 1, 1)
        renderer.UseDepthPeelingOn()    # translucent surfaces in their order
        renderer.SetMaximumNumberOfPeels(16)
        renderer.SetOcclusionRatio(0)
        for one in actors:
            renderer.AddActor(one)
        camera = renderer.GetActiveCamera()
        camera.ParallelProjectionOn()
        camera.SetFocalPoint(*self.centre)
        camera.SetPosition(*(self.centre + 3 * self.far * self.back))
        camera.SetViewUp(*self.up)
        camera.SetParallelScale(self.size[1] / 2 / self.scale)
        renderer.ResetCameraClippingRange()
        renderer.RemoveAllLights()
        for place, intensity in (((-0.5, 0.8, 1), 0.85), ((0.8, 0.3, 0.8), 0.35)):
            light = vtkLight()
            light.SetLightTypeToCameraLight()
            light.SetPosition(*place)
            light.SetIntensity(intensity)
            renderer.AddLight(light)
        window.Render()
        grab.SetInput(window)
        grab.ReadFrontBufferOff()
        grab.Update()
        shown = vtk_to_numpy(grab.GetOutput().GetPointData().GetScalars())
        shown = shown.reshape(FINER * self.size[1], FINER * self.size[0], -1)[::-1, :, :3]
        return Image.fromarray(np.ascontiguousarray(shown)).reduce(FINER)


def arrow(picture, camera, points, colour=INK):
    """A line through points of the scene, with a head at its end."""
    way = [camera.pixel(p) for p in points]
    draw = ImageDraw.Draw(picture)
    draw.line(way, fill=colour, width=5, joint="curve")
    tip, before = np.array(way[-1]), np.array(way[-2])
    along = (tip - before) / np.linalg.norm(tip - before)
    side = np.array([-along[1], along[0]])
    draw.polygon([tuple(tip + 14 * along), tuple(tip - 8 * along + 11 * side), tuple(tip - 8 * along - 11 * side)], fill=colour)


def below(picture, scale, bar, time, key):
    """The picture with its scale bar (length, words), the time and the key: words alone, pairs of a colour and words, or
    (words, least, most) of a range of viridis."""
    font = ImageFont.truetype(FONT, TEXT)
    high, width = TEXT + 14, picture.width
    pieces = []    # of the key: width, draw at x, y
    if isinstance(key, str):
        pieces.append((font.getlength(key), lambda d, x, y, words=key: d.text((x, y), words, INK, font)))
    elif isinstance(key, tuple):
        words, least, most = key
        low, up = f"{least:g}", f"{most:g} {words}"

        def ramp(d, x, y):
            d.text((x, y), low, INK, font)
            x += font.getlength(low) + 10
            for k in range(140):
                d.line((x + k, y + 4, x + k, y + TEXT), fill=tuple(int(round(255 * c)) for c in viridis(k / 139)))
            d.text((x + 150, y), up, INK, font)
        pieces.append((font.getlength(low) + 160 + font.getlength(up), ramp))
    else:
        for colour, words in key or ():
            def dot(d, x, y, colour=colour, words=words):
                d.ellipse((x, y + 4, x + 24, y + 28), fill=colour)
                d.text((x + 32, y), words, INK, font)
            pieces.append((32 + font.getlength(words) if words else 12, dot))
    lines, x = [[]], 0    # as many pieces a line as it has room for
    for wide, paint in pieces:
        if x and x + wide > width - 2 * EDGE:
            lines.append([])
            x = 0
        lines[-1].append((x, paint))
        x += wide + 24
    whole = Image.new("RGB", (width, picture.height + MARGIN + high * (1 + (len(lines) if pieces else 0))), "white")
    whole.paste(picture, (0, 0))
    draw, y = ImageDraw.Draw(whole), picture.height + MARGIN
    length = bar[0] * scale
    draw.line((EDGE, y + 16, EDGE + length, y + 16), fill=INK, width=5)
    for x in (EDGE, EDGE + length):
        draw.line((x, y + 6, x, y + 26), fill=INK, width=3)
    draw.text((EDGE + length + 14, y), bar[1], INK, font)
    if time:
        draw.text((width - font.getlength(time) - EDGE, y), time, INK, font)
    if time and length + 14 + font.getlength(bar[1]) + 20 > width - 2 * EDGE - font.getlength(time):
        raise SystemExit(f"'{bar[1]}' and '{time}' do not fit beside each other")
    for line in lines if pieces else ():
        y += high
        for x, paint in line:
            paint(draw, EDGE + x, y)
    return whole

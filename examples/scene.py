# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Draw spheres, superellipsoids and meshes with VTK.

Needs VTK (Debian's python3-paraview or python3-vtk9), a display, which xvfb-run makes, and PIL."""
import math

import numpy as np
from PIL import Image
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPlane, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkClipPolyData, vtkFeatureEdges, vtkPolyDataNormals
from vtkmodules.vtkIOGeometry import vtkSTLReader
from vtkmodules.vtkRenderingCore import (vtkActor, vtkLight, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow,
                                         vtkWindowToImageFilter)
from vtkmodules.vtkRenderingOpenGL2 import vtkOpenGLSphereMapper

from look import DARK, STEEL, View, rgb

SHARP = 35    # degrees: a fold that is drawn as an edge; flatter ones are shaded as a smooth surface
FINER = 2     # a pixel is the mean of so many by so many


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


def surface(half, exponents, rings, sides):
    """Points and outward normals of superellipsoids, of normals on rings about the third axis from pole to pole: arrays of
    grains, points, 3. Where the surface bends most, the points are densest."""
    tilt, turn = np.meshgrid(np.linspace(0, math.pi, rings), np.linspace(0, 2 * math.pi, sides, endpoint=False), indexing="ij")
    normals = np.stack([np.sin(tilt) * np.cos(turn), np.sin(tilt) * np.sin(turn), np.cos(tilt)], axis=-1).reshape(-1, 3)
    q1, q2 = (n[:, None] / (n[:, None] - 1) for n in np.asarray(exponents, float).T)
    scaled = np.asarray(half, float)[:, None, :] * normals
    x, y, z = np.moveaxis(np.maximum(np.abs(scaled), 1e-30), -1, 0)
    around = x**q2 + y**q2
    support = (around**(q1 / q2) + z**q1)**(1 / q1)
    out = around**(q1 / q2 - 1)
    points = np.stack([out * x**(q2 - 1), out * y**(q2 - 1), z**(q1 - 1)], axis=-1) * (support**(1 - q1))[..., None]
    return points * np.sign(scaled) * np.asarray(half, float)[:, None, :], normals


def turned(quaternions, vectors):
    """Vectors (grains, points, 3) in the frames of grains, by quaternions w, x, y, z."""
    w, axis = quaternions[:, None, :1], quaternions[:, None, 1:]
    across = 2 * np.cross(axis, vectors)
    return vectors + w * across + np.cross(axis, across)


def superellipsoids(centres, half, exponents, quaternions, colours):
    """Half-axes, the exponents n1 and n2 and the quaternion of each, as LAMMPS has them."""
    count = len(centres)
    rings, sides = (17, 24) if count < 5000 else (11, 14)
    points, normals = surface(half, exponents, rings, sides)
    points = turned(quaternions, points) + np.asarray(centres)[:, None, :]
    normals = turned(quaternions, np.broadcast_to(normals, points.shape))
    ring, side = np.meshgrid(np.arange(rings - 1), np.arange(sides), indexing="ij")
    corners = np.stack([ring * sides + side, (ring + 1) * sides + side, (ring + 1) * sides + (side + 1) % sides,
                        ring * sides + (side + 1) % sides], axis=-1).reshape(1, -1, 4)
    ids = (corners + (np.arange(count) * rings * sides)[:, None, None]).reshape(-1, 4)
    data, place, cells = vtkPolyData(), vtkPoints(), vtkCellArray()
    place.SetData(numpy_to_vtk(np.ascontiguousarray(points.reshape(-1, 3), np.float32), deep=1))
    data.SetPoints(place)
    cells.SetCells(len(ids), numpy_to_vtkIdTypeArray(np.insert(ids, 0, 4, axis=1).astype(np.int64).ravel(), deep=1))
    data.SetPolys(cells)
    data.GetPointData().SetNormals(numpy_to_vtk(np.ascontiguousarray(normals.reshape(-1, 3), np.float32), deep=1))
    of_points = np.repeat(np.asarray(colours) * 255, rings * sides, axis=0)
    data.GetPointData().SetScalars(numpy_to_vtk(np.ascontiguousarray(of_points, np.uint8), deep=1))
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(data)
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


class Camera(View):
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

# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 The Graupel authors
"""Draws bed and flow of a run to a PNG, without a screen.

    scripts/render DIR [PNG]            (installed: graupel-render); default: DIR/figures/bed.png

Left: the particles at the last moment, coloured by their contacts with others. Right: the
interstitial velocity of the fluid on the plane y = 0 at its last moment, and streamlines
that begin near the bottom; of a run without a fluid, or without particles, the other part
alone. Needs Debian's python3-vtk9, and xvfb where there is no display. Exit status: 0 if the
picture was written, 1 if it could not be.
"""

import argparse
import os
import shutil
import sys
from pathlib import Path

import numpy as np

from .run import Run

try:
    import vtkmodules.vtkRenderingFreeType  # noqa: F401
    import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
    from vtkmodules.vtkCommonCore import vtkLookupTable
    from vtkmodules.vtkCommonDataModel import vtkPlane
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkUnstructuredGrid
    from vtkmodules.vtkFiltersCore import vtkCutter, vtkGlyph3D
    from vtkmodules.vtkFiltersFlowPaths import vtkStreamTracer
    from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
    from vtkmodules.vtkFiltersSources import vtkLineSource, vtkSphereSource
    from vtkmodules.vtkIOImage import vtkPNGWriter
    from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
    from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer
    from vtkmodules.vtkRenderingCore import vtkRenderWindow, vtkWindowToImageFilter
except ImportError as error:
    sys.exit(f"render: {error}. It needs VTK: apt-get install python3-vtk9.")

SIZE = (1400, 1200)  # of the picture [pixels]
CONTACTS = "coordination_number"
FACETS = 24  # of a sphere around its axis
STREAMLINES = 24
# Corners of two cells nearer than this to each other, over the size of the mesh, are one.
SAME_POINT = 1e-5
FOR_SCENE = 0.72  # of the width of a view; the bar has the rest
GREY = (0.45, 0.45, 0.45)


def last(run, stem):
    """What the last file of a series holds, or None."""
    try:
        read = {"particles": run.particles, "solution": run.fields}[stem]()
    except (FileNotFoundError, IndexError):
        return None
    return read if len(read.points) else None


def array_of(values, name):
    """An array as VTK has it."""
    array = numpy_to_vtk(np.ascontiguousarray(values, dtype=float), deep=True)
    array.SetName(name)
    return array


def grid_of(points, values, connectivity, kinds, sizes):
    """Cells of so many points each, with values at the points."""
    grid = vtkUnstructuredGrid()
    places = vtkPoints()
    places.SetData(array_of(points, "Points"))
    grid.SetPoints(places)
    cells = vtkCellArray()
    offsets = np.concatenate(([0], np.cumsum(sizes)))
    ids = [one.astype(np.int64) for one in (offsets, connectivity)]
    cells.SetData(*(numpy_to_vtkIdTypeArray(one, deep=True) for one in ids))
    grid.SetCells(numpy_to_vtk(kinds.astype(np.uint8), deep=True), cells)
    for name, one in values.items():
        grid.GetPointData().AddArray(array_of(one, name))
    return grid


def joined(fields):
    """The fields with one point where corners of several cells meet: in the file each cell has
    its own, and streamlines would end there."""
    size = np.ptp(fields.points, axis=0).max()
    whole = np.round(fields.points / (SAME_POINT * size)).astype(np.int64)
    _, kept, number = np.unique(whole, axis=0, return_index=True, return_inverse=True)
    speed = np.linalg.norm(fields.values["velocity"], axis=1)
    values = {"velocity": fields.values["velocity"][kept], "speed": speed[kept]}
    sizes = np.diff(fields.offsets, prepend=0)
    corners = number.ravel()[fields.connectivity]
    return grid_of(fields.points[kept], values, corners, fields.kinds, sizes)


def colours(low, high):
    """A table of colours from blue to red."""
    table = vtkLookupTable()
    table.SetHueRange(0.667, 0.0)
    table.SetSaturationRange(0.75, 0.75)
    table.SetRange(low, high)
    table.Build()
    return table


def coloured(source, name, limits):
    """The mapper of a filter's surface in the colours of a value at its points."""
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray(name)
    mapper.SetLookupTable(colours(*limits))
    mapper.SetScalarRange(*limits)
    return mapper


def actor_of(mapper):
    """What is drawn of a mapper."""
    actor = vtkActor()
    actor.SetMapper(mapper)
    return actor


def add_bar(renderer, mapper, title):
    """A colour bar at the right edge of a view."""
    bar = vtkScalarBarActor()
    bar.SetLookupTable(mapper.GetLookupTable())
    bar.SetTitle(title)
    bar.SetNumberOfLabels(5)
    bar.SetUnconstrainedFontSize(True)
    for text in (bar.GetTitleTextProperty(), bar.GetLabelTextProperty()):
        text.SetColor(0.1, 0.1, 0.1)
        text.SetFontSize(20)
        text.ItalicOff()
        text.ShadowOff()
        text.BoldOff()
    bar.SetPosition(0.80, 0.15)
    bar.SetWidth(0.13)
    bar.SetHeight(0.6)
    renderer.AddActor2D(bar)


def view(place):
    """A white view on a part of the window."""
    renderer = vtkRenderer()
    renderer.SetViewport(*place)
    renderer.SetBackground(1.0, 1.0, 1.0)
    return renderer


def look_from_the_side(renderer, bounds, n_views):
    """From -y, z upwards, a little from above; the colour bar has the right of the view."""
    middle = [0.5 * (low + high) for low, high in zip(bounds[::2], bounds[1::2])]
    width, height = bounds[1] - bounds[0], bounds[5] - bounds[4]
    camera = renderer.GetActiveCamera()
    camera.SetFocalPoint(*middle)
    camera.SetPosition(middle[0], middle[1] - 1.0, middle[2] + 0.12)
    camera.SetViewUp(0.0, 0.0, 1.0)
    camera.ParallelProjectionOn()
    renderer.ResetCameraClippingRange()
    shape = SIZE[0] / n_views / SIZE[1]
    camera.SetParallelScale(0.5 * max(1.15 * height + 0.12 * width, width / (FOR_SCENE * shape)))
    camera.SetWindowCenter(1.0 - FOR_SCENE, 0.0)


def draw_bed(particles, renderer):
    """Spheres in the colours of their number of contacts."""
    sphere = vtkSphereSource()
    sphere.SetRadius(0.5)  # of a unit diameter
    sphere.SetThetaResolution(FACETS)
    sphere.SetPhiResolution(FACETS // 2)
    n = len(particles.points)
    points = grid_of(
        particles.points,
        {name: particles.values[name] for name in ("diameter", CONTACTS)},
        np.arange(n), np.ones(n), np.ones(n),
    )  # fmt: skip
    points.GetPointData().SetActiveScalars("diameter")
    glyphs = vtkGlyph3D()
    glyphs.SetInputData(points)
    glyphs.SetSourceConnection(sphere.GetOutputPort())
    glyphs.SetScaleModeToScaleByScalar()
    glyphs.OrientOff()
    most = float(particles.values[CONTACTS].max())
    mapper = coloured(glyphs, CONTACTS, (0.0, max(most, 1.0)))
    renderer.AddActor(actor_of(mapper))
    add_bar(renderer, mapper, "contacts [-]")


def draw_flow(fields, renderer):
    """The vessel's outline, speeds on the plane y = 0, and streamlines."""
    grid = joined(fields)
    limits = grid.GetPointData().GetArray("speed").GetRange()
    bounds = grid.GetBounds()

    plane = vtkPlane()
    plane.SetOrigin(*grid.GetCenter())
    plane.SetNormal(0.0, 1.0, 0.0)
    cut = vtkCutter()
    cut.SetInputData(grid)
    cut.SetCutFunction(plane)
    mapper = coloured(cut, "speed", limits)
    renderer.AddActor(actor_of(mapper))
    add_bar(renderer, mapper, "velocity [m/s]")

    seeds = vtkLineSource()
    margin = 0.02 * (bounds[1] - bounds[0])
    height = bounds[4] + 0.02 * (bounds[5] - bounds[4])
    front = bounds[2] + 0.45 * (bounds[3] - bounds[2])  # before the plane
    seeds.SetPoint1(bounds[0] + margin, front, height)
    seeds.SetPoint2(bounds[1] - margin, front, height)
    seeds.SetResolution(STREAMLINES)
    lines = vtkStreamTracer()
    lines.SetInputData(grid)
    lines.SetSourceConnection(seeds.GetOutputPort())
    lines.SetInputArrayToProcess(0, 0, 0, 0, "velocity")
    lines.SetIntegratorTypeToRungeKutta45()
    lines.SetMaximumNumberOfSteps(20000)
    lines.SetMaximumPropagation(4.0 * (bounds[5] - bounds[4]))
    traced = vtkPolyDataMapper()
    traced.SetInputConnection(lines.GetOutputPort())
    traced.ScalarVisibilityOff()
    drawn = actor_of(traced)
    drawn.GetProperty().SetColor(0.05, 0.05, 0.05)
    drawn.GetProperty().SetLineWidth(1.2)
    renderer.AddActor(drawn)

    shell = vtkGeometryFilter()
    shell.SetInputData(grid)
    skin = vtkPolyDataMapper()
    skin.SetInputConnection(shell.GetOutputPort())
    skin.ScalarVisibilityOff()
    wall = actor_of(skin)
    wall.GetProperty().SetColor(*GREY)
    wall.GetProperty().SetOpacity(0.12)
    renderer.AddActor(wall)


def draw(directory, target):
    """Writes the picture; returns the exit status."""
    run = Run(directory)
    drawers = ((last(run, "particles"), draw_bed), (last(run, "solution"), draw_flow))
    shown = [(read, drawer) for read, drawer in drawers if read is not None]
    if not shown:
        print(f"render: {directory} has no files for ParaView.", file=sys.stderr)
        return 1
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(4)
    window.SetSize(*SIZE)
    # All views show the vessel if there is a mesh, which comes last.
    points = shown[-1][0].points
    bounds = np.stack((points.min(axis=0), points.max(axis=0)), axis=1).ravel()
    for number, (read, drawer) in enumerate(shown):
        renderer = view((number / len(shown), 0.0, (number + 1) / len(shown), 1.0))
        drawer(read, renderer)
        look_from_the_side(renderer, bounds, len(shown))
        window.AddRenderer(renderer)
    window.Render()
    image = vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    target.parent.mkdir(parents=True, exist_ok=True)
    writer = vtkPNGWriter()
    writer.SetFileName(str(target))
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()
    if not target.is_file():
        print(f"render: {target} cannot be written.", file=sys.stderr)
        return 1
    print(target)
    return 0


def main():
    """Reads the command line; returns the exit status."""
    parser = argparse.ArgumentParser(
        prog="render", description="Draws bed and flow of a run to a PNG."
    )
    parser.add_argument("directory", type=Path, metavar="DIR", help="output directory of a run")
    parser.add_argument(
        "target", type=Path, nargs="?", metavar="PNG", help="default: DIR/figures/bed.png"
    )
    arguments = parser.parse_args()
    # Debian's VTK draws through X; a virtual display does where there is none.
    if "DISPLAY" not in os.environ:
        server = shutil.which("xvfb-run")
        if server is None:
            sys.exit("render: there is no display; apt-get install xvfb xauth makes a virtual one.")
        command = [server, "--auto-servernum", "--server-args=-screen 0 1600x1400x24"]
        os.execv(server, [*command, sys.executable, *sys.argv])
    target = arguments.target or arguments.directory / "figures" / "bed.png"
    return draw(arguments.directory, target)

#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws a glTF scene with VTK and prints how long a frame takes, as JSON.

A peer for the transparency benchmark: an unlit scene of triangles with vertex or base colours, one colour a face, is
drawn off screen with VTK's dual depth peeling (without a limit that matters: 100 peels, occlusion ratio 0) or with
plain alpha blending in the order of the file.  All translucent triangles are one polydata, which is VTK's fastest way.
Colours are taken as they are: no lighting, no transfer function.

    xvfb-run -a python3 vtk_depth_peeling.py scene.gltf --method dual-peel --background 0.1,0.12,0.16

With --serve it draws on demand, so that another program can take turns with it: it reads "frame" or "picture FILE" from
its standard input and answers with one line of JSON each, until the input ends.
"""
import argparse
import base64
import json
import os
import sys
import time

import numpy as np
import vtkmodules.vtkRenderingOpenGL2 as opengl
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints, vtkVersion
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkRenderingCore import (vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow,
                                         vtkWindowToImageFilter)

COMPONENTS = {5120: np.int8, 5121: np.uint8, 5122: np.int16, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
WIDTHS = {'SCALAR': 1, 'VEC2': 2, 'VEC3': 3, 'VEC4': 4}


class Gltf:
    """What of a .gltf file a scene of coloured triangles needs."""

    def __init__(self, path):
        with open(path, encoding='utf-8') as file:
            self.json = json.load(file)
        self.buffers = []
        for buffer in self.json['buffers']:
            uri = buffer['uri']
            if uri.startswith('data:'):
                self.buffers.append(base64.b64decode(uri.split(',', 1)[1]))
            else:
                with open(os.path.join(os.path.dirname(path), uri), 'rb') as file:
                    self.buffers.append(file.read())
        self.camera = None  # (camera, world_from_view) of the first one in node order
        self.primitives = []  # (primitive, world_from_object) in node order
        scene = self.json['scenes'][self.json.get('scene', 0)]
        for root in scene['nodes']:
            self._walk(root, np.eye(4))

    def accessor(self, index):
        """[count, width] values; normalised integers as floats."""
        accessor = self.json['accessors'][index]
        view = self.json['bufferViews'][accessor['bufferView']]
        kind = np.dtype(COMPONENTS[accessor['componentType']])
        width, count = WIDTHS[accessor['type']], accessor['count']
        offset = view.get('byteOffset', 0) + accessor.get('byteOffset', 0)
        stride = view.get('byteStride', 0) or kind.itemsize * width
        values = np.ndarray((count, width), kind, self.buffers[view['buffer']], offset, (stride, kind.itemsize))
        return values / np.float32(np.iinfo(kind).max) if accessor.get('normalized') else values

    def _walk(self, index, parent):
        node = self.json['nodes'][index]
        world = parent @ local_matrix(node)
        if 'camera' in node and self.camera is None:
            self.camera = (self.json['cameras'][node['camera']], world)
        if 'mesh' in node:
            self.primitives += [(p, world) for p in self.json['meshes'][node['mesh']]['primitives']]
        for child in node.get('children', []):
            self._walk(child, world)


def local_matrix(node):
    if 'matrix' in node:
        return np.array(node['matrix'], float).reshape(4, 4).T
    out = np.eye(4)
    x, y, z, w = node.get('rotation', (0, 0, 0, 1))
    out[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                   [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                   [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    out[:3, :3] = out[:3, :3] @ np.diag(node.get('scale', (1, 1, 1)))
    out[:3, 3] = node.get('translation', (0, 0, 0))
    return out


def merge(gltf, translucent):
    """One actor of all triangles that are translucent, or of all that are not; None where there are none."""
    points, triangles, colors, count = [], [], [], 0
    for primitive, world in gltf.primitives:
        material = gltf.json['materials'][primitive['material']]
        if (material.get('alphaMode') == 'BLEND') != translucent:
            continue
        attributes = primitive['attributes']
        position = gltf.accessor(attributes['POSITION']).astype(float) @ world[:3, :3].T + world[:3, 3]
        index = gltf.accessor(primitive['indices']).reshape(-1, 3).astype(np.int64)
        color = np.tile(material.get('pbrMetallicRoughness', {}).get('baseColorFactor', [1, 1, 1, 1]),
                        (len(position), 1)).astype(float)
        if 'COLOR_0' in attributes:
            vertex = gltf.accessor(attributes['COLOR_0'])
            color[:, :vertex.shape[1]] *= vertex
        points.append(position.astype(np.float32))
        triangles.append(index + count)
        colors.append(color[index[:, 0]])
        count += len(position)
    if not points:
        return None
    data, corners, cells = vtkPolyData(), vtkPoints(), vtkCellArray()
    corners.SetData(numpy_to_vtk(np.vstack(points), deep=1))
    index = np.vstack(triangles)
    cells.SetCells(len(index), numpy_to_vtkIdTypeArray(
        np.hstack([np.full((len(index), 1), 3, np.int64), index]).ravel(), deep=1))
    codes = numpy_to_vtk((np.vstack(colors) * 255 + 0.5).astype(np.uint8), deep=1)
    codes.SetName('color')
    data.SetPoints(corners)
    data.SetPolys(cells)
    data.GetCellData().SetScalars(codes)
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(data)
    mapper.SetScalarModeToUseCellData()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().LightingOff()
    if translucent:
        actor.ForceTranslucentOn()
    return actor


def set_method(renderer, method):
    if method == 'dual-peel':
        renderer.SetUseDepthPeeling(1)
        renderer.SetMaximumNumberOfPeels(100)
        renderer.SetOcclusionRatio(0.0)
        return
    # Plain blending; what the renderer does by default in VTK 9 is weighted blending.
    passes = opengl.vtkRenderPassCollection()
    for one in (opengl.vtkLightsPass(), opengl.vtkOpaquePass(), opengl.vtkTranslucentPass()):
        passes.AddItem(one)
    sequence = opengl.vtkSequencePass()
    sequence.SetPasses(passes)
    camera = opengl.vtkCameraPass()
    camera.SetDelegatePass(sequence)
    renderer.SetPass(camera)


def set_camera(renderer, camera, world):
    view, eye = renderer.GetActiveCamera(), world[:3, 3]
    perspective = camera['perspective']
    view.SetPosition(*eye)
    view.SetFocalPoint(*(eye - world[:3, 2]))
    view.SetViewUp(*world[:3, 1])
    view.SetViewAngle(np.degrees(perspective['yfov']))
    view.SetClippingRange(perspective['znear'], perspective.get('zfar', 1000 * perspective['znear']))


def write_pfm(path, window):
    """The picture as linear values k/255, bottom row first."""
    grab = vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.SetInputBufferTypeToRGB()
    grab.ReadFrontBufferOff()
    grab.ShouldRerenderOff()
    grab.Update()
    image = grab.GetOutput()
    width, height, _ = image.GetDimensions()
    codes = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, 3)
    with open(path, 'wb') as file:
        file.write(b'PF\n%d %d\n-1.0\n' % (width, height))
        file.write((codes / 255.0).astype('<f4').tobytes())


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('scene', help='.gltf file: unlit, vertex or base colours, indexed triangles')
    parser.add_argument('--method', choices=['dual-peel', 'plain'], default='dual-peel')
    parser.add_argument('--size', default='512x512', help='WIDTHxHEIGHT')
    parser.add_argument('--background', default='0,0,0', help='R,G,B, each 0 to 1')
    parser.add_argument('--frames', type=int, default=17, help='timed frames')
    parser.add_argument('--warm-up', type=int, default=3, help='frames before them')
    parser.add_argument('--serve', action='store_true', help='draw when asked to')
    parser.add_argument('--picture', help='write the last frame to this PFM file')
    options = parser.parse_args()

    gltf = Gltf(options.scene)
    if gltf.camera is None or 'perspective' not in gltf.camera[0]:
        sys.exit(f'{options.scene}: has no perspective camera')
    renderer, window = vtkRenderer(), vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetAlphaBitPlanes(1)
    window.SetSize(*(int(n) for n in options.size.split('x')))
    window.AddRenderer(renderer)
    renderer.SetBackground(*(float(v) for v in options.background.split(',')))
    for translucent in (False, True):
        actor = merge(gltf, translucent)
        if actor:
            renderer.AddActor(actor)
    set_method(renderer, options.method)
    set_camera(renderer, *gltf.camera)

    about = {'program': 'VTK ' + vtkVersion.GetVTKVersion(), 'method': options.method}

    def draw():
        start = time.perf_counter()
        window.Render()
        window.WaitForCompletion()
        return 1e3 * (time.perf_counter() - start)

    def answer(**more):
        print(json.dumps({**about, 'peeled': bool(renderer.GetLastRenderingUsedDepthPeeling()), **more}), flush=True)

    if options.serve:
        draw()
        answer()
        for request in sys.stdin:
            word, _, argument = request.strip().partition(' ')
            if word == 'frame':
                answer(ms=draw())
            elif word == 'picture':
                write_pfm(argument, window)
                answer(picture=argument)
        return
    times = [draw() for _ in range(options.warm_up + options.frames)][options.warm_up:]
    if options.picture:
        write_pfm(options.picture, window)
    answer(median_ms=float(np.median(times)), ms=[round(t, 4) for t in times])


if __name__ == '__main__':
    main()

# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""Blender's space (+Z up) in glTF's (+Y up), in which cameras and lights look along their own -Z in both."""
from mathutils import Matrix

TO_GLTF = Matrix(((1, 0, 0, 0), (0, 0, 1, 0), (0, -1, 0, 0), (0, 0, 0, 1)))
FROM_GLTF = TO_GLTF.inverted()


def columns(matrix):
    """As glTF's "matrix"."""
    return [matrix[row][column] for column in range(4) for row in range(4)]


def local_place(matrix):
    """Of a matrix in Blender's space, for an object whose own axes are turned with the world."""
    return TO_GLTF @ matrix @ FROM_GLTF


def parts(matrix):
    """Translation, rotation (x, y, z, w) and scale."""
    translation, rotation, scale = matrix.decompose()
    return list(translation), [rotation.x, rotation.y, rotation.z, rotation.w], list(scale)


def smooth_rotations(rotations):
    """Quaternions of neighbouring frames on the same side."""
    result = []
    for q in rotations:
        if result and sum(a * b for a, b in zip(result[-1], q)) < 0:
            q = [-c for c in q]
        result.append(q)
    return result

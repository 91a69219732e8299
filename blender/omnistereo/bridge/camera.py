# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""The camera: its place as a node, and all else as our camera file (docs/camera-sidecar.md)."""
import math

from .places import TO_GLTF, columns


def degrees(angle):
    """Without what single precision adds."""
    return round(math.degrees(angle), 4)


def panorama_of(data):
    """Where this Blender keeps the properties of a panorama."""
    return data if hasattr(data, "panorama_type") else data.cycles


def _projection(data, report):
    pano = panorama_of(data)
    if pano.panorama_type == "EQUIRECTANGULAR":
        return {
            "name": "lat-long",
            "longitude": [degrees(pano.longitude_min), degrees(pano.longitude_max)],
            "latitude": [degrees(pano.latitude_min), degrees(pano.latitude_max)],
        }
    if pano.panorama_type == "FISHEYE_EQUIDISTANT":
        return {"name": "fisheye", "fov": degrees(pano.fisheye_fov)}
    report.warn(f"camera '{data.name}': its panorama {pano.panorama_type} does not come across; --projection chooses one")
    return None


def _stereo(scene, data):
    stereo = data.stereo
    keys = {"ipd": stereo.interocular_distance}
    parallel = stereo.convergence_mode == "PARALLEL"
    keys["convergence"] = {"mode": "parallel"} if parallel else {"mode": "toe-in", "distance": stereo.convergence_distance}
    merge = {"mode": "none"}
    if stereo.use_pole_merge:
        start, end = degrees(stereo.pole_merge_angle_from), degrees(stereo.pole_merge_angle_to)
        merge = {"mode": "cosine", "start": start, "end": max(end, start + 1e-3)}
    keys["merge_top"] = keys["merge_bottom"] = merge
    return keys


def attitude(matrix):
    """Yaw, pitch and roll in degrees of a camera at a place."""
    place = TO_GLTF @ matrix
    forward, right = -place.col[2].xyz.normalized(), place.col[0].xyz.normalized()
    pitch = math.asin(max(-1.0, min(1.0, forward.y)))
    yaw = math.atan2(forward.x, -forward.z)
    level = (math.cos(yaw), 0.0, math.sin(yaw))
    roll = math.atan2(-right.y, max(1e-12, sum(a * b for a, b in zip(level, right)))) if abs(forward.y) < 0.9999 else 0.0
    return tuple(degrees(a) + 0.0 for a in (yaw, pitch, roll))


def describe(scene, camera, matrix, report):
    """The camera file of the scene's camera, as a dictionary."""
    data = camera.data
    place = TO_GLTF @ matrix
    yaw, pitch, roll = attitude(matrix)
    file = {"omnistereo_camera": 1, "made_by": "Blender", "position": list(place.translation), "yaw": yaw}
    if data.type == "PANO":
        # A panorama is tilted on purpose; a window is level in a headset.
        file["pitch"], file["roll"] = pitch, roll
        projection = _projection(data, report)
        if projection:
            file["projection"] = projection
    if scene.render.use_multiview:
        file.update(_stereo(scene, data))
    return file


def add_node(glb, camera, matrix):
    data = camera.data
    index = glb.append("cameras", {
        "name": data.name,
        "type": "perspective",
        "perspective": {"yfov": min(max(data.angle_y, 0.01), 3.0) if data.type == "PERSP" else 1.0, "znear": 0.01},
    })
    return glb.add_root({"name": camera.name, "camera": index, "matrix": columns(TO_GLTF @ matrix)})

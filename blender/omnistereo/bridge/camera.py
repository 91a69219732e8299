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


def _projection(scene, data, ledger):
    pano = panorama_of(data)
    path = "" if pano == data else "cycles."
    kind = pano.panorama_type
    read = lambda name: ledger.read(data, path + name)
    ledger.tick(data, path + "panorama_type", "sensor_width", "sensor_height", "sensor_fit", "lens", "angle")
    if kind == "EQUIRECTANGULAR":
        return {
            "name": "lat-long",
            "longitude": [degrees(read("longitude_min")), degrees(read("longitude_max"))],
            "latitude": [degrees(read("latitude_min")), degrees(read("latitude_max"))],
        }
    if kind == "FISHEYE_EQUIDISTANT":
        return {"name": "fisheye", "fov": degrees(read("fisheye_fov"))}
    if kind == "MIRRORBALL":
        return {"name": "mirror-ball"}
    if kind == "EQUIANGULAR_CUBEMAP_FACE":
        return {"name": "eac-face"}
    width, height = _sensor(scene, data)
    if kind == "FISHEYE_EQUISOLID":
        lens, fov = read("fisheye_lens"), read("fisheye_fov")
        # The direction of the sensor's edge. Our picture ends there or at the end of the view, whichever comes first.
        edge = 4.0 * math.asin(min(1.0, min(width, height) / (4.0 * max(lens, 1e-3))))
        if not 0.9 < edge / fov < 1.1:
            ledger.lose("the circle of a fisheye fills its picture here", "camera", data.name)
        return {"name": "fisheye-equisolid", "fov": degrees(min(edge, fov))}
    if kind == "FISHEYE_LENS_POLYNOMIAL":
        return {"name": "fisheye-polynomial", "fov": degrees(read("fisheye_fov")), "sensor": [width, height],
                "polynomial": [read(f"fisheye_polynomial_k{i}") for i in range(5)]}
    ledger.lose(f"the panorama {kind} does not come across", "camera", data.name, "--projection chooses one")
    return None


def _sensor(scene, data):
    """Width and height in millimetres: the longer side of the picture has the sensor's width."""
    render = scene.render
    width = render.resolution_x * render.pixel_aspect_x
    height = render.resolution_y * render.pixel_aspect_y
    if data.sensor_fit == "VERTICAL":
        return data.sensor_height * width / height, data.sensor_height
    longer = width if data.sensor_fit == "HORIZONTAL" else max(width, height)
    return data.sensor_width * width / longer, data.sensor_width * height / longer


def _lens(camera, matrix, ledger):
    """The aperture as Cycles has it, and the distance in focus."""
    data = camera.data
    if not ledger.read(data, "dof.use_dof"):
        return None
    distance, target = ledger.read(data, "dof.focus_distance"), ledger.read(data, "dof.focus_object")
    ledger.tick(data, "dof.focus_subtarget")
    if target is not None:
        distance = abs((target.matrix_world.translation - matrix.translation).dot(matrix.col[2].xyz.normalized()))
    return {"radius": data.lens * 1e-3 / (2.0 * max(ledger.read(data, "dof.aperture_fstop"), 1e-5)),
            "focus_distance": max(distance, 1e-3)}


def _stereo(data, unit):
    stereo = data.stereo
    keys = {"ipd": stereo.interocular_distance * unit}
    parallel = stereo.convergence_mode == "PARALLEL"
    keys["convergence"] = {"mode": "parallel"} if parallel else {
        "mode": "toe-in", "distance": stereo.convergence_distance * unit}
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


def describe(scene, camera, matrix, ledger):
    """The camera file of a camera, as a dictionary. Lengths are metres."""
    data, unit = camera.data, scene.unit_settings.scale_length
    place = TO_GLTF @ matrix
    yaw, pitch, roll = attitude(matrix)
    file = {"omnistereo_camera": 1, "made_by": "Blender", "position": [c * unit for c in place.translation], "yaw": yaw}
    ledger.tick(data, "type")
    if data.type == "PANO":
        # A panorama is tilted on purpose; a window is level in a headset.
        file["pitch"], file["roll"] = pitch, roll
        projection = _projection(scene, data, ledger)
        if projection:
            file["projection"] = projection
    else:  # its window is not used
        ledger.tick(data, "lens", "angle", "angle_x", "angle_y", "ortho_scale", "sensor_width", "sensor_height",
                    "sensor_fit", "shift_x", "shift_y")
    lens = _lens(camera, matrix, ledger)
    if lens:
        file["lens"] = {key: value * unit for key, value in lens.items()}
    else:
        ledger.tick(data, *(f"dof.{p.identifier}" for p in data.dof.bl_rna.properties))
    if scene.render.use_multiview:
        file.update(_stereo(data, unit))
    ledger.close("camera", [data])
    return file


def add_node(glb, camera, matrix, name=""):
    data = camera.data
    index = glb.append("cameras", {
        "name": data.name,
        "type": "perspective",
        "perspective": {"yfov": min(max(data.angle_y, 0.01), 3.0) if data.type == "PERSP" else 1.0, "znear": 0.01},
    })
    return glb.add_root({"name": name or camera.name, "camera": index, "matrix": columns(TO_GLTF @ matrix)})

#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""Recognition rate of ods convert for files of other programs: photographs and panoramas from packages, converted by
FFmpeg to common formats. Prints the table of docs/identify.md.

    bench/identify_others.py build/release/ods FOLDER             # the half used for the weights of the marks
    bench/identify_others.py build/release/ods FOLDER --held-out  # the half that is held out

Downloads into FOLDER, once: npm's @pmndrs/assets (18 panoramas by Poly Haven's photographers), Debian's
lomiri-wallpapers-16.04, lomiri-wallpapers-20.04 and mate-backgrounds (photographs), opencv-doc (stereo pairs). Two eyes
with a panorama's textures are rendered in a cube of it, 4 m wide, with objects in it; if FOLDER/renders has stereo
panoramas (bench/lint_others.sh), those are used, too: *yard* for the weights, *hall* held out."""
import base64, collections, concurrent.futures, glob, json, os, random, re, struct, subprocess, sys

PHOTOS = ("lomiri-wallpapers-16.04", "lomiri-wallpapers-20.04", "mate-backgrounds", "opencv-doc")


def run(*words, **more):
    return subprocess.run([str(word) for word in words], check=True, capture_output=True, text=True, **more)


def ffmpeg(source, target, filters, *more):
    """Makes one picture from one or two."""
    if os.path.exists(target):
        return target
    sources = [source] if isinstance(source, str) else source
    inputs = [word for each in sources for word in ("-i", each)]
    kind = "-filter_complex" if len(sources) > 1 or "[" in filters else "-vf"
    run("ffmpeg", "-v", "error", "-y", *inputs, kind, filters, "-frames:v", 1, *more, target)
    return target


# --- downloads ----------------------------------------------------------------------------------------------------

def fetch(folder):
    if not os.path.isdir(f"{folder}/panoramas"):
        run("npm", "pack", "@pmndrs/assets@1.7.0", cwd=folder)
        run("tar", "xzf", "pmndrs-assets-1.7.0.tgz", "--wildcards", "package/hdri/*.exr.js", cwd=folder)
        os.mkdir(f"{folder}/panoramas")
        for script in glob.glob(f"{folder}/package/hdri/*.exr.js"):
            data = re.search(r"base64,([A-Za-z0-9+/=]+)", open(script).read()).group(1)
            with open(f"{folder}/panoramas/{os.path.basename(script)[:-3]}", "wb") as file:
                file.write(base64.b64decode(data))
    for package in PHOTOS:
        if not os.path.isdir(f"{folder}/{package}"):
            run("apt-get", "download", package, cwd=folder)
            run("dpkg", "-x", glob.glob(f"{folder}/{package}_*.deb")[0], f"{folder}/{package}")


def photographs(folder):
    found = glob.glob(f"{folder}/lomiri*/usr/share/backgrounds/*.jpg")
    found += glob.glob(f"{folder}/mate-backgrounds/usr/share/backgrounds/mate/nature/*.jpg")
    drawn = ("analogpattern", "Painting", "Picture_0B", "Infinite-Sea", "Picture_1A")
    return sorted(path for path in found if not os.path.basename(path).startswith(drawn))


# --- two eyes -----------------------------------------------------------------------------------------------------

def cube_scene(faces, seed):
    """A cube of six pictures, 4 m wide, with boxes of the same pictures in it: unlit, as glTF."""
    place = random.Random(seed)
    boxes = [((0, 0, 0), 2.0)]
    for i in range(7):
        away = place.uniform(0.9, 1.6)
        boxes.append(((away * place.choice((-1, 1)) * place.uniform(0.4, 1), place.uniform(-0.9, 0.6),
                       away * place.choice((-1, 1)) * place.uniform(0.4, 1)), place.uniform(0.1, 0.25)))
    # Right and down of each face, seen from within: r l u d f b.
    sides = [((0, 0, 1), (0, -1, 0)), ((0, 0, -1), (0, -1, 0)), ((1, 0, 0), (0, 0, -1)), ((1, 0, 0), (0, 0, 1)),
             ((1, 0, 0), (0, -1, 0)), ((-1, 0, 0), (0, -1, 0))]
    centers = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, -1), (0, 0, 1)]
    binary, views, accessors, primitives = b"", [], [], []

    def add(data, count, kind, component, **more):
        nonlocal binary
        views.append({"buffer": 0, "byteOffset": len(binary), "byteLength": len(data)})
        accessors.append({"bufferView": len(views) - 1, "count": count, "type": kind, "componentType": component, **more})
        binary += data + b"\0" * (-len(data) % 4)
        return len(accessors) - 1

    indices = add(struct.pack("<6H", 0, 1, 2, 0, 2, 3), 6, "SCALAR", 5123)
    corners = ((-1, -1), (1, -1), (1, 1), (-1, 1))
    uv = add(b"".join(struct.pack("<2f", 0.5 + 0.5 * s, 0.5 + 0.5 * t) for s, t in corners), 4, "VEC2", 5126)
    for at, half in boxes:
        for side, (right, down) in enumerate(sides):
            points = [[at[k] + half * (centers[side][k] + s * right[k] + t * down[k]) for k in range(3)]
                      for s, t in corners]
            low, high = [min(p[k] for p in points) for k in range(3)], [max(p[k] for p in points) for k in range(3)]
            where = add(b"".join(struct.pack("<3f", *p) for p in points), 4, "VEC3", 5126, min=low, max=high)
            primitives.append({"attributes": {"POSITION": where, "TEXCOORD_0": uv}, "indices": indices,
                               "material": side})
    return {"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_materials_unlit"], "scenes": [{"nodes": [0]}],
            "scene": 0, "nodes": [{"mesh": 0}], "meshes": [{"primitives": primitives}],
            "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": i}}, "doubleSided": True,
                           "extensions": {"KHR_materials_unlit": {}}} for i in range(6)],
            "textures": [{"source": i} for i in range(6)], "images": [{"uri": os.path.basename(f)} for f in faces],
            "buffers": [{"byteLength": len(binary), "uri": "data:application/octet-stream;base64,"
                         + base64.b64encode(binary).decode()}], "bufferViews": views, "accessors": accessors}


def two_eyes(ods, folder, name, panorama, seed):
    path = f"{folder}/eyes/{name}.png"
    if os.path.exists(path):
        return path
    faces = []
    for side, turn in zip("rludfb", ("yaw=90", "yaw=-90", "pitch=90", "pitch=-90", "yaw=0", "yaw=180")):
        faces.append(ffmpeg(panorama, f"{folder}/eyes/{name}-{side}.png",
                            f"v360=e:flat:h_fov=90:v_fov=90:w=512:h=512:{turn}"))
    with open(f"{folder}/eyes/{name}.gltf", "w") as file:
        json.dump(cube_scene(faces, seed), file)
    run(ods, "render", f"{folder}/eyes/{name}.gltf", "--position", "0,0,0", "--width", 1536, "--samples", 6,
        "--tone", "linear", "-o", path, "--layout", "top-bottom")
    return path


# --- the files ----------------------------------------------------------------------------------------------------

JPEG = ("-q:v", 4)
PHONE = ("-c:v", "libx264", "-crf", 30, "-pix_fmt", "yuv420p")  # and a JPEG of its frame
MARK = "drawbox=x=iw*0.80:y=ih*0.90:w=iw*0.15:h=ih*0.05:color=white@0.6:t=fill," \
       "drawbox=x=iw*0.82:y=ih*0.91:w=iw*0.02:h=ih*0.03:color=black@0.6:t=fill"
DISC = "geq=lum='if(lte(hypot(X-W/2,Y-H/2),W/2*{r}),lum(X,Y),16)':cb='if(lte(hypot(X-W/2,Y-H/2),W/2*{r}),cb(X,Y),128)'" \
       ":cr='if(lte(hypot(X-W/2,Y-H/2),W/2*{r}),cr(X,Y),128)'"
EYES = "split[a][b];[a]crop=iw:ih/2:0:0,{left}[l];[b]crop=iw:ih/2:0:ih/2,{right}[r];[l][r]{stack}"


def of_eyes(each, stack="hstack", then=""):
    return EYES.format(left=each, right=each, stack=stack) + ("," + then if then else "")


def phoned(source, target, filters):
    """As forwarded by a messenger: smaller, by H.264, and a picture of that."""
    film = ffmpeg(source, target[:-4] + ".mkv", filters, *PHONE)
    return ffmpeg(film, target, "null", *JPEG)


def files_of_panorama(name, path, out):
    dual = "split[a][b];[a]v360=e:fisheye:h_fov=195:v_fov=195:w=600:h=600,format=yuv420p,{disc}[l];" \
           "[b]v360=e:fisheye:h_fov=195:v_fov=195:yaw=180:w=600:h=600,format=yuv420p,{disc}[r];[l][r]hstack"
    yield "360, one eye", "one eye, lat-long", ffmpeg(path, f"{out}/{name}-360.jpg", "scale=1024:512", *JPEG)
    yield "360, one eye, sent on by phone", "one eye, lat-long", phoned(path, f"{out}/{name}-360p.jpg", "scale=640:320")
    yield "360, one eye, with a mark", "one eye, lat-long", \
        ffmpeg(path, f"{out}/{name}-360m.jpg", f"scale=1024:512,{MARK}", *JPEG)
    for cube in ("c6x1", "c1x6"):
        size = (1536, 256) if cube == "c6x1" else (256, 1536)
        yield f"cube strip px nx py ny pz nz, {'6x1' if cube == 'c6x1' else '1x6'}", "none: faces of a cube", \
            ffmpeg(path, f"{out}/{name}-{cube}.jpg", f"v360=e:{cube}:w={size[0]}:h={size[1]}", *JPEG)
    yield "front and back fisheye", "front and back", \
        ffmpeg(path, f"{out}/{name}-dual.jpg", dual.format(disc=DISC.format(r=0.98)), *JPEG)
    yield "360, one eye, black bars to 16:9", "one eye, lat-long", \
        ffmpeg(path, f"{out}/{name}-bars.jpg", "scale=1280:640,pad=1280:720:0:40", *JPEG)


def files_of_eyes(name, path, out):
    half = "v360=e:hequirect:w=640:h=640"
    flat = "v360=e:flat:h_fov=80:v_fov=52:w=800:h=450"
    lens = "v360=e:fisheye:h_fov=180:v_fov=180:w=720:h=720,format=yuv420p," + DISC.format(r=0.99)
    cut = "pad=800:720:40:0:black,crop=800:600:0:60"  # the sensor is less high than the circle
    yield "360, two eyes", "top-bottom, lat-long", ffmpeg(path, f"{out}/{name}-tb.jpg", "scale=1024:1024", *JPEG)
    yield "360, two eyes, sent on by phone", "top-bottom, lat-long", \
        phoned(path, f"{out}/{name}-tbp.jpg", "scale=640:640")
    yield "360, two eyes, with a mark", "top-bottom, lat-long", \
        ffmpeg(path, f"{out}/{name}-tbm.jpg", f"scale=1024:1024,{MARK}", *JPEG)
    yield "vr180", "side-by-side, vr180", ffmpeg(path, f"{out}/{name}-180.jpg", of_eyes(half), *JPEG)
    yield "vr180, sent on by phone", "side-by-side, vr180", \
        phoned(path, f"{out}/{name}-180p.jpg", of_eyes(half, then="scale=720:360"))
    yield "vr180 squeezed into 16:9", "side-by-side, vr180", \
        ffmpeg(path, f"{out}/{name}-180s.jpg", of_eyes(half, then="scale=1280:720"), *JPEG)
    yield "vr180 squeezed into 16:9, sent on by phone", "side-by-side, vr180", \
        phoned(path, f"{out}/{name}-180sp.jpg", of_eyes(half, then="scale=854:480"))
    yield "vr180 with black bars to 16:9", "side-by-side, vr180", \
        ffmpeg(path, f"{out}/{name}-180b.jpg", of_eyes(half, then="pad=1280:720:0:40"), *JPEG)
    yield "pair of fisheyes", "side-by-side, fisheye", ffmpeg(path, f"{out}/{name}-fish.jpg", of_eyes(lens), *JPEG)
    yield "pair of fisheyes, circles cut", "side-by-side, fisheye", \
        ffmpeg(path, f"{out}/{name}-cut.jpg", of_eyes(f"{lens},{cut}"), *JPEG)
    yield "window, two eyes", "side-by-side, perspective", \
        ffmpeg(path, f"{out}/{name}-sbs.jpg", of_eyes(flat), *JPEG)
    yield "window, two squeezed eyes", "side-by-side-half, perspective", \
        ffmpeg(path, f"{out}/{name}-hsbs.jpg", of_eyes(flat, then="scale=800:450"), *JPEG)
    yield from anaglyphs(name, ffmpeg(path, f"{out}/{name}-sbs.png", of_eyes(flat)), out)
    yield "anaglyph of 360", "none: an anaglyph", \
        ffmpeg(path, f"{out}/{name}-an360.jpg", "scale=1024:1024,stereo3d=abl:arcd", *JPEG)


def anaglyphs(name, side_by_side, out):
    for kind in ("arcd", "arch", "arcg", "agmd", "aybd"):
        yield f"anaglyph, {kind}", "none: an anaglyph", \
            ffmpeg(side_by_side, f"{out}/{name}-{kind}.jpg", f"stereo3d=sbsl:{kind}", *JPEG)


def files_of_pair(name, left, right, out):
    both = ffmpeg([left, right], f"{out}/{name}-sbs.png", "hstack,scale=1280:-2")
    yield "pair of photographs", "side-by-side, perspective", ffmpeg(both, f"{out}/{name}-sbs.jpg", "null", *JPEG)
    yield from anaglyphs(name, both, out)


def files_of_photograph(name, path, out):
    for shape, size in (("as taken", "scale=1024:-2"), ("2:1", "scale=1024:-2,crop=iw:min(ih\\,iw/2),scale=1024:512"),
                        ("1:1", "scale=-2:720,crop=min(iw\\,ih):min(iw\\,ih)"),
                        ("16:9, black bars", "scale=960:720:force_original_aspect_ratio=decrease,"
                                             "pad=1280:720:(ow-iw)/2:(oh-ih)/2")):
        word = shape.replace(":", "").replace(" ", "").replace(",", "")
        yield f"photograph, {shape}", "one eye, perspective", ffmpeg(path, f"{out}/{name}-{word}.jpg", size, *JPEG)


def all_files(ods, folder, held_out):
    out = f"{folder}/{'held' if held_out else 'weighed'}"
    for each in ("eyes", "plain", os.path.basename(out)):
        os.makedirs(f"{folder}/{each}", exist_ok=True)
    mine = slice(1 if held_out else 0, None, 2)
    for i, panorama in list(enumerate(sorted(glob.glob(f"{folder}/panoramas/*.exr"))))[mine]:
        name = os.path.basename(panorama)[:-4]
        plain = f"{folder}/plain/{name}.png"
        if not os.path.exists(plain):
            run(ods, "convert", panorama, "--layout", "separate", "--projection", "lat-long", "-o", plain)
        yield from files_of_panorama(name, plain, out)
        yield from files_of_eyes(name + "-2", two_eyes(ods, folder, name, plain, i), out)
    for render in sorted(glob.glob(f"{folder}/renders/*{'hall' if held_out else 'yard'}*.png")):
        yield from files_of_eyes(os.path.basename(render)[:-4], render, out)
    for photo in photographs(folder)[mine]:
        yield from files_of_photograph(os.path.basename(photo)[:-4], photo, out)
    data = f"{folder}/opencv-doc/usr/share/doc/opencv-doc/examples/data"
    pairs = [("aloe", f"{data}/aloeL.jpg", f"{data}/aloeR.jpg")]
    pairs += [(f"board{i:02}", f"{data}/left{i:02}.jpg", f"{data}/right{i:02}.jpg") for i in (1, 2, 3, 4)]
    for name, left, right in pairs[mine]:
        yield from files_of_pair(name, left, right, out)


# --- results ------------------------------------------------------------------------------------------------------

VERDICTS = ("right", "asked", "wrong, not sure", "sure and wrong")


def verdict(ods, truth, path):
    """The format that ods convert detected in a file, and the verdict. If no format is right, stopping to ask is."""
    made = path + ".out.png"
    done = subprocess.run([ods, "convert", path, "-o", made, "--width", "96"], capture_output=True, text=True)
    if os.path.exists(made):
        os.remove(made)
    said = done.stderr
    unsure = "specify it with" in said
    if done.returncode != 0:
        if truth.startswith("none") and truth[6:] in said:
            return 0, said
        asks = "is ambiguous" in said or "is not recorded" in said
        return (1 if done.returncode == 3 and asks else 2), said
    if "two fisheyes that look ahead and back" in said:
        taken = "front and back"
    elif "a pair of fisheyes" in said:
        taken = "side-by-side, fisheye"
    else:
        notes = re.findall(r"^ods: " + re.escape(path) + r": ([a-z0-9- ]+): ", said, re.M)
        taken = ", ".join(notes[:2])
    if taken == truth:
        return 0, said
    named = unsure and (truth + " (") in said
    return (1 if named else 2 if unsure else 3), said


def main():
    words = [word for word in sys.argv[1:] if not word.startswith("-")]
    ods, folder = os.path.abspath(words[0]), os.path.abspath(words[1])
    only = words[2] if len(words) > 2 else ""
    os.makedirs(folder, exist_ok=True)
    fetch(folder)
    files = [each for each in all_files(ods, folder, "--held-out" in sys.argv) if only in each[0]]
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        seen = list(pool.map(lambda file: verdict(ods, file[1], file[2]), files))
    table = collections.OrderedDict()
    for (family, truth, path), (which, said) in zip(files, seen):
        table.setdefault(family, [0] * len(VERDICTS))[which] += 1
        if which > 0 and "-v" in sys.argv:
            print(f"{VERDICTS[which].upper()}: {family}: {os.path.basename(path)}: " + said.strip().replace("\n", " | "))
    print("| family | files | " + " | ".join(VERDICTS) + " |\n|---|---|" + "---|" * len(VERDICTS))
    for family, counts in list(table.items()) + [("all", [sum(each) for each in zip(*table.values())])]:
        print(f"| {family} | {sum(counts)} | " + " | ".join(f"{100 * c / sum(counts):.1f}" for c in counts) + " |")


if __name__ == "__main__":
    main()

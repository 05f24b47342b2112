#!/usr/bin/env python3
"""Renders the same ball in Candela and in Mitsuba 3, for every material that both have, and compares the
pictures: the mean of each channel to 0.1 %, and every block of 8x8 pixels by a z-test with the variances of
both, at a significance of 0.01 over all blocks of all cases.

    mitsuba_materials.py CANDELA [NAME ...]

Exit status 0: they agree; 1: they do not; 77: Mitsuba cannot be imported (skipped).
"""

import json
import math
import random
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import mitsuba as mi
    import numpy as np
except ImportError as error:
    print(f"skipped: {error}; install it with: pip install mitsuba")
    sys.exit(77)

SIZE, BLOCK, SEEDS, SPP = 48, 8, 8, 256
MEAN_TOLERANCE, SIGNIFICANCE = 0.001, 0.01


class Together:
    """A material of ours that names others, which the scene then holds, too."""

    def __init__(self, material, **parts):
        self.material, self.parts = material, parts


class Sum:
    """Weighted pictures of several of Mitsuba's BSDFs."""

    def __init__(self, *parts):
        self.parts = parts


def cases():
    """(name, Candela's material, Mitsuba's BSDF); only what both mean the same by."""
    yield "diffuse", {"type": "diffuse", "diffuse": [0.8, 0.5, 0.2]}, {
        "type": "twosided", "bsdf": {"type": "diffuse", "reflectance": rgb(0.8, 0.5, 0.2)}}
    for ior in (1.33, 1.5, 2.4):
        yield f"dielectric {ior}", {"type": "dielectric", "ior": ior}, {
            "type": "dielectric", "int_ior": ior, "ext_ior": 1.0}
    for metal in ("Ag", "Al", "Au", "Cr", "Cu", "W"):
        yield f"conductor {metal}", {"type": "conductor", "metal": metal, "roughness": 0}, {
            "type": "conductor", "material": metal}
    for distribution in ("ggx", "beckmann"):
        for roughness in (0.2, 0.4, 0.7, 1.0):
            rough = {"roughness": roughness, "distribution": distribution, "energy_compensation": False}
            facets = {"distribution": distribution, "alpha": roughness ** 2}
            yield f"conductor {distribution} {roughness}", {"type": "conductor", "metal": "Au", **rough}, {
                "type": "roughconductor", "material": "Au", **facets}


    # At roughness 1 ours is 1.8 % darker: Mitsuba masks both sides independently, we by heights that correlate.
    for roughness in (0.2, 0.5):
        yield f"rough dielectric {roughness}", {
            "type": "rough_dielectric", "roughness": roughness, "energy_compensation": False}, {
            "type": "roughdielectric", "int_ior": 1.5, "ext_ior": 1.0, "distribution": "ggx", "alpha": roughness ** 2}
    yield "thin dielectric", {"type": "thin_dielectric", "ior": 1.5}, {
        "type": "thindielectric", "int_ior": 1.5, "ext_ior": 1.0}
    for nonlinear in (False, True):
        yield f"plastic{' nonlinear' * nonlinear}", {
            "type": "plastic", "diffuse": [0.6, 0.3, 0.1], "ior": 1.5, "roughness": 0, "nonlinear": nonlinear}, {
            "type": "twosided", "bsdf": {"type": "plastic", "diffuse_reflectance": rgb(0.6, 0.3, 0.1), "int_ior": 1.5,
                                         "ext_ior": 1.0, "nonlinear": nonlinear}}
    for name, values in PRINCIPLED.items():
        yield f"principled {name}", {"type": "principled", "base_color": [0.7, 0.4, 0.2], **values}, {
            "type": "principled", "base_color": rgb(0.7, 0.4, 0.2), **values}


    matte, their_matte = {"type": "diffuse", "diffuse": [0.7, 0.3, 0.2]}, {
        "type": "diffuse", "reflectance": rgb(0.7, 0.3, 0.2)}
    gloss, their_gloss = {"type": "principled", "base_color": [0.1, 0.3, 0.6], "roughness": 0.5}, {
        "type": "principled", "base_color": rgb(0.1, 0.3, 0.6), "roughness": 0.5}
    metal, their_metal = {"type": "conductor", "metal": "Cu", "roughness": 0}, {"type": "conductor", "material": "Cu"}

    def blend(weight):
        return {"type": "blend", "first": "a", "second": "b", "weight": weight}
    yield "blend", Together(blend(0.3), a=matte, b=gloss), {
        "type": "twosided", "bsdf": {"type": "blendbsdf", "weight": 0.3, "a": their_matte, "b": their_gloss}}
    tiles = {"type": "checker", "name": "tiles", "even": 0.9, "odd": 0.1, "squares": 8}
    yield "blend by checker", Together(blend({"texture": "tiles"}), a=matte, b=gloss, textures=[tiles]), {
        "type": "twosided", "bsdf": {"type": "blendbsdf", "a": their_matte, "b": their_gloss, "weight": {
            "type": "checkerboard", "color0": 0.9, "color1": 0.1, "to_uv": mi.ScalarTransform4f().scale([4, 4, 1])}}}
    # Mitsuba's blendbsdf with a mirror is up to 3.6 % darker than its own pictures of the parts, which add up on a
    # ball that sees no other surface.
    yield "blend with a mirror", Together(blend(0.3), a=matte, b=metal), Sum(
        (0.7, {"type": "twosided", "bsdf": their_matte}), (0.3, {"type": "twosided", "bsdf": their_metal}))
    yield "two sided", Together({"type": "two_sided", "front": "a", "back": "b"}, a=matte, b=metal), {
        "type": "twosided", "a": their_matte, "b": their_metal}
    yield "two sided metal", Together({"type": "two_sided", "front": "b", "back": "a"}, a=matte, b=metal), {
        "type": "twosided", "a": their_metal, "b": their_matte}
    yield "null", {"type": "null"}, {"type": "null"}


PRINCIPLED = {
    "default": {"roughness": 0.5},
    "metal": {"metallic": 1.0, "roughness": 0.3},
    "coat": {"roughness": 0.6, "clearcoat": 1.0, "clearcoat_gloss": 0.8},
    "cloth": {"roughness": 0.9, "sheen": 1.0, "sheen_tint": 0.5},
    "flat": {"roughness": 0.7, "flatness": 1.0},
    "tinted": {"roughness": 0.4, "specular": 0.9, "spec_tint": 1.0},
}


def rgb(*color):
    return {"type": "rgb", "value": list(color)}


def mitsuba_camera(position):
    """Looks at the origin."""
    return {"type": "perspective", "fov": 36, "fov_axis": "y",
            "to_world": mi.ScalarTransform4f().look_at(position, [0, 0, 0], [0, 1, 0]),
            "film": {"type": "hdrfilm", "width": SIZE, "height": SIZE, "rfilter": {"type": "box"},
                     "component_format": "float32", "pixel_format": "rgb"},
            "sampler": {"type": "independent"}}


# A ball under a grey sky between two lamps, one near.
LAMPS = [([2.5, 2.0, 1.5], 0.8, [12.0, 10.0, 8.0]), ([-3.0, 0.5, -1.0], 1.5, [3.0, 4.0, 6.0])]


def candela_scene(material):
    def lamp(position, size, i):
        x, y, z = position
        yaw = math.degrees(math.atan2(-x, -z))
        pitch = math.degrees(math.atan2(y, math.hypot(x, z)))
        return {"shape": "rectangle", "material": f"lamp {i}",
                "transform": [{"scale": [size, size, 1]}, {"rotate": [1, 0, 0, pitch]}, {"rotate": [0, 1, 0, yaw]},
                              {"translate": position}]}
    parts = material.parts if isinstance(material, Together) else {}
    ball = material.material if parts else material
    textures = parts.get("textures", [])
    materials = [{"name": "ball", **ball}]
    materials += [{"name": name, **part} for name, part in parts.items() if name != "textures"]
    materials += [{"name": f"lamp {i}", "type": "diffuse", "diffuse": 0, "emission": e}
                  for i, (_, _, e) in enumerate(LAMPS)]
    return {"candela": 1, "camera": {"position": [0, 0, 4], "target": [0, 0, 0], "vertical_fov": 36},
            "materials": materials, "textures": textures, "lights": [{"type": "constant", "color": 0.5}],
            "instances": [{"shape": "sphere", "radius": 1, "material": "ball"}]
            + [lamp(p, s, i) for i, (p, s, _) in enumerate(LAMPS)],
            "settings": {"film": {"width": SIZE, "height": SIZE}}}


def mitsuba_scene(bsdf):
    T = mi.ScalarTransform4f
    scene = {"type": "scene", "integrator": {"type": "path", "max_depth": -1},
             "sensor": mitsuba_camera([0, 0, 4]),
             "sky": {"type": "constant", "radiance": rgb(0.5, 0.5, 0.5)},
             "ball": {"type": "sphere", "bsdf": bsdf}}
    for i, (position, size, emission) in enumerate(LAMPS):
        scene[f"lamp{i}"] = {
            "type": "rectangle", "to_world": T().look_at(position, [0, 0, 0], [0, 1, 0]) @ T().scale([size, size, 1]),
            "bsdf": {"type": "diffuse", "reflectance": rgb(0, 0, 0)},
            "emitter": {"type": "area", "radiance": rgb(*emission)}}
    return mi.load_dict(scene)


def read_pfm(path):
    data = path.read_bytes()
    kind, size, scale, rest = data.split(b"\n", 3)
    width, height = map(int, size.split())
    pixels = np.frombuffer(rest, "<f4" if float(scale) < 0 else ">f4").reshape(height, width, 3)
    return pixels[::-1].astype(np.float64)


def blocks(picture):
    n = SIZE // BLOCK
    return picture.reshape(n, BLOCK, n, BLOCK, 3).mean(axis=(1, 3))


def statistics(pictures):
    """Mean and variance of the mean: of blocks, and of the whole picture."""
    b = np.stack([blocks(p) for p in pictures])
    whole = b.mean(axis=(1, 2))
    return (b.mean(0), b.var(0, ddof=1) / len(b)), (whole.mean(0), whole.var(0, ddof=1) / len(b))


def render_candela(program, scene, folder):
    file, out = folder / "scene.json", folder / "out.pfm"
    file.write_text(json.dumps(scene))
    pictures = []
    for _ in range(SEEDS):
        subprocess.run([program, "render", str(file), "-o", str(out), "--spp", str(SPP), "--seed",
                        str(random.randrange(2 ** 31)), "--quiet", "--no-state", "--set", "sampler.type=independent"],
                       check=True)
        pictures.append(read_pfm(out))
    return statistics(pictures)


def render_mitsuba(bsdf):
    parts = bsdf.parts if isinstance(bsdf, Sum) else ((1.0, bsdf),)
    scenes = [(weight, mitsuba_scene(part)) for weight, part in parts]
    return statistics([sum(weight * np.array(mi.render(scene, spp=SPP, seed=random.randrange(2 ** 31)), dtype=np.float64)
                           for weight, scene in scenes) for _ in range(SEEDS)])


def two_sided_p(t, degrees):
    """Of Student's t, by its distribution's integral; a variance of 8 pictures is itself uncertain."""
    x = degrees / (degrees + t * t)
    steps = 4000
    # I_x(a, 1/2) with u = s^2, which takes the pole at 1 away.
    a = degrees / 2
    u = (np.arange(steps) + 0.5) / steps
    integrand = lambda upper: np.sum(2 * (1 - (s := u * upper) ** 2) ** (a - 1)) * upper / steps
    whole = integrand(1.0)
    return 1 - integrand(math.sqrt(1 - x)) / whole


def compare(name, ours, theirs, count):
    (block, variance), (mean, mean_variance) = ours
    (their_block, their_variance), (their_mean, their_mean_variance) = theirs
    error = np.abs(mean / their_mean - 1)
    uncertain = 4 * np.sqrt(mean_variance + their_mean_variance) / their_mean
    t = np.abs(block - their_block) / np.sqrt(variance + their_variance + (1e-5 * block) ** 2 + 1e-14)
    threshold = 1 - (1 - SIGNIFICANCE) ** (1 / (count * t.size))
    worst = two_sided_p(t.max(), 2 * (SEEDS - 1))
    good = bool(np.all(error < MEAN_TOLERANCE + uncertain)) and worst > threshold
    print(f"{'agrees ' if good else 'DIFFERS'} {name:28} mean {np.round((mean / their_mean - 1) * 100, 3)} %, "
          f"worst block t {t.max():.2f}, p {worst:.2g} (limit {threshold:.2g})", flush=True)
    return good


def main():
    program, wanted = sys.argv[1], sys.argv[2:]
    mi.set_variant("scalar_rgb")
    chosen = [c for c in cases() if not wanted or any(w in c[0] for w in wanted)]
    bad = 0
    with tempfile.TemporaryDirectory() as folder:
        for name, material, bsdf in chosen:
            ours = render_candela(program, candela_scene(material), Path(folder))
            bad += not compare(name, ours, render_mitsuba(bsdf), len(chosen))
    print(f"{len(chosen) - bad} of {len(chosen)} materials agree with Mitsuba {mi.__version__}")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())

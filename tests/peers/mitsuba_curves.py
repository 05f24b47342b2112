#!/usr/bin/env python3
"""Renders the same strands as B-spline curves in Candela and in Mitsuba 3 (`bsplinecurve`) and compares the
pictures as mitsuba_materials.py does: means to 0.1 %, blocks of 8x8 pixels by Student's t. The strands end in
balls, for ours are closed there and Mitsuba's are not.

    mitsuba_curves.py CANDELA [NAME ...]

Exit status 0: they agree; 1: they do not; 77: Mitsuba cannot be imported (skipped).
"""

import random
import sys
import tempfile
from pathlib import Path

from mitsuba_materials import SEEDS, SIZE, SPP, compare, mi, mitsuba_camera, np, render_candela, rgb, statistics

DIFFUSE = ({"type": "diffuse", "diffuse": [0.8, 0.5, 0.2]}, {"type": "diffuse", "reflectance": rgb(0.8, 0.5, 0.2)})


def cases():
    """(name, radii of root and tip, Candela's material, Mitsuba's BSDF)"""
    yield "thick tubes", (0.12, 0.12), *DIFFUSE
    yield "tapered tubes", (0.14, 0.03), *DIFFUSE
    yield "thin tubes", (0.02, 0.02), *DIFFUSE
    for roughness in (0.3, 0.6):
        yield f"hair {roughness}", (0.05, 0.03), {
            "type": "hair", "parametrization": "absorption", "sigma_a": [0.25, 0.45, 0.9], "beta_m": roughness,
            "beta_n": roughness, "alpha": 2, "ior": 1.55}, {
            "type": "hair", "sigma_a": rgb(0.25, 0.45, 0.9), "longitudinal_roughness": roughness,
            "azimuthal_roughness": roughness, "scale_tilt": 2.0, "int_ior": 1.55, "ext_ior": 1.0}


def strands(radii):
    """Control points x y z radius of seven strands from one ball to another."""
    out = []
    for k in range(7):
        points = []
        for i in range(8):
            u = (i - 1) / 5
            swing = 0.35 * np.sin(2.5 * u * np.pi + k) * (0 <= u <= 1)
            points.append((0.35 * (k - 3) + swing * 0.4, -1.2 + 2.4 * u, 0.5 * swing, radii[0] + u * (radii[1] - radii[0])))
        out.append(points)
    return out


BALLS = [(0.35 * (k - 3), y, 0, 0.3) for k in range(7) for y in (-1.2, 1.2)]


def candela_scene(radii, material):
    made = strands(radii)
    return {"candela": 1, "camera": {"position": [0, 0.2, 4], "target": [0, 0, 0], "vertical_fov": 36},
            "materials": [{"name": "strands", **material}, {"name": "grey", "diffuse": 0.5},
                          {"name": "lamp", "diffuse": 0, "emission": [9, 8, 7]}],
            "lights": [{"type": "constant", "color": 0.5}],
            "instances": [
                {"shape": "curves", "strands": [[p[:3] for p in s] for s in made],
                 "widths": [[2 * p[3] for p in s] for s in made], "material": "strands"},
                {"shape": "rectangle", "material": "lamp", "transform": [{"scale": 0.7}, {"rotate": [0, 1, 0, 180]},
                 {"translate": [1.5, 1.2, 3.5]}]},
                {"shape": "rectangle", "material": "grey", "transform": [{"scale": 4}, {"translate": [0, 0, -1.2]}]}]
            + [{"shape": "sphere", "radius": r, "material": "grey", "transform": [{"translate": [x, y, z]}]}
               for x, y, z, r in BALLS],
            "settings": {"film": {"width": SIZE, "height": SIZE}}}


def mitsuba_scene(radii, bsdf, folder):
    T = mi.ScalarTransform4f
    grey = {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": rgb(0.5, 0.5, 0.5)}}
    file = folder / "strands.txt"
    file.write_text("\n\n".join("\n".join("%.9g %.9g %.9g %.9g" % p for p in s) for s in strands(radii)) + "\n")
    scene = {"type": "scene", "integrator": {"type": "path", "max_depth": -1},
             "sensor": mitsuba_camera([0, 0.2, 4]),
             "sky": {"type": "constant", "radiance": rgb(0.5, 0.5, 0.5)},
             "strands": {"type": "bsplinecurve", "filename": str(file), "bsdf": bsdf},
             "lamp": {"type": "rectangle", "to_world": T().translate([1.5, 1.2, 3.5]) @ T().rotate([0, 1, 0], 180) @ T().scale(0.7),
                      "bsdf": {"type": "diffuse", "reflectance": rgb(0, 0, 0)},
                      "emitter": {"type": "area", "radiance": rgb(9, 8, 7)}},
             "wall": {"type": "rectangle", "to_world": T().translate([0, 0, -1.2]) @ T().scale(4), "bsdf": grey}}
    for i, (x, y, z, r) in enumerate(BALLS):
        scene[f"ball{i}"] = {"type": "sphere", "center": [x, y, z], "radius": r, "bsdf": grey}
    return mi.load_dict(scene)


def main():
    program, wanted = sys.argv[1], sys.argv[2:]
    mi.set_variant("scalar_rgb")
    chosen = [c for c in cases() if not wanted or any(w in c[0] for w in wanted)]
    bad = 0
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for case, radii, material, bsdf in chosen:
            scene = mitsuba_scene(radii, bsdf, folder)
            theirs = statistics([np.array(mi.render(scene, spp=SPP, seed=random.randrange(2 ** 31)), dtype=np.float64)
                                 for _ in range(SEEDS)])
            bad += not compare(case, render_candela(program, candela_scene(radii, material), folder), theirs, len(chosen))
    print(f"{len(chosen) - bad} of {len(chosen)} kinds of strands agree with Mitsuba {mi.__version__}")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())

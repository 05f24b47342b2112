# Renders with Cycles what versus_cycles (cycles.h) wrote, as often as its standard input asks:
#
#   blender -b --factory-startup --python cycles_render.py -- FOLDER [NAME=VALUE ...]
#
# NAME is a property of scene.cycles. Each line "SEED SPP FILE.exr" makes a picture and is answered by
# "versus_cycles rendered SECONDS".

import array
import json
import math
import os
import struct
import sys

import bpy
import mathutils

folder, *overrides = sys.argv[sys.argv.index("--") + 1:]
with open(os.path.join(folder, "scene.json")) as f:
    description = json.load(f)


def turned(v):
    """Candela's panoramas have +y on top and +z in their centre, Blender's +z and +x: the whole scene turns."""
    return mathutils.Vector((v[2], v[0], v[1]))


def show(data, name="object"):
    thing = bpy.data.objects.new(name, data)
    scene.collection.objects.link(thing)
    return thing


def nodes_of(tree):
    tree.nodes.clear()
    return tree.nodes, tree.links


def computed(nodes, links, operation, *inputs):
    """The output of a node that computes it of numbers and of other nodes' outputs."""
    node = nodes.new("ShaderNodeMath")
    node.operation = operation
    for socket, value in zip(node.inputs, inputs):
        if isinstance(value, (int, float)):
            socket.default_value = value
        else:
            links.new(value, socket)
    return node.outputs[0]


def smoke_density(nodes, links):
    """As smoke_density() of scenes.h, in its axes: see turned()."""
    def do(operation, *inputs):
        return computed(nodes, links, operation, *inputs)
    separate = nodes.new("ShaderNodeSeparateXYZ")
    links.new(nodes.new("ShaderNodeNewGeometry").outputs["Position"], separate.inputs[0])
    z, x, y = separate.outputs
    square = do("ADD", do("ADD", do("MULTIPLY", x, x), do("MULTIPLY", y, y)), do("MULTIPLY", z, z))
    sine = do("SINE", do("ADD", do("MULTIPLY", x, 9), do("MULTIPLY", y, 4)))
    cosine = do("COSINE", do("SUBTRACT", do("MULTIPLY", z, 8), do("MULTIPLY", x, 3)))
    wave = do("ADD", do("MULTIPLY", sine, cosine), 0.3)
    return do("MULTIPLY", do("MAXIMUM", do("SUBTRACT", 1, square), 0), do("MAXIMUM", wave, 0))


def make_material(m):
    material = bpy.data.materials.new("material")
    material.use_nodes = True
    nodes, links = nodes_of(material.node_tree)
    output = nodes.new("ShaderNodeOutputMaterial")
    if m["type"] in ("volume", "smoke"):
        scatters, absorbs, total = (nodes.new("ShaderNode" + name) for name in ("VolumeScatter", "VolumeAbsorption", "AddShader"))
        scatters.inputs["Color"].default_value, absorbs.inputs["Color"].default_value = (1, 1, 1, 1), (0, 0, 0, 1)
        for shader, density in ((scatters, m["sigma_s"]), (absorbs, m["sigma_a"])):
            shader.inputs["Density"].default_value = density
            if m["type"] == "smoke":
                links.new(computed(nodes, links, "MULTIPLY", smoke_density(nodes, links), density), shader.inputs["Density"])
        scatters.inputs["Anisotropy"].default_value = m["g"]
        links.new(scatters.outputs[0], total.inputs[0])
        links.new(absorbs.outputs[0], total.inputs[1])
        links.new(total.outputs[0], output.inputs["Volume"])
        material.cycles.homogeneous_volume = m["type"] == "volume"
        return material
    if m["type"] == "ggx":
        shader = nodes.new("ShaderNodeBsdfGlossy")
        shader.distribution = "GGX"
        shader.inputs["Color"].default_value = (*m["specular"], 1)
        shader.inputs["Roughness"].default_value = m["roughness"]  # both square it to get alpha
    elif m["type"] == "glass":
        shader = nodes.new("ShaderNodeBsdfGlass")
        shader.distribution = "GGX"
        shader.inputs["Color"].default_value = (1, 1, 1, 1)
        shader.inputs["Roughness"].default_value = m["roughness"]
        shader.inputs["IOR"].default_value = m["ior"]
    elif m["type"] == "principled":
        shader = nodes.new("ShaderNodeBsdfPrincipled")
        shader.distribution = "GGX"
        shader.inputs["Base Color"].default_value = (*m["base_color"], 1)
        for ours, theirs in (("roughness", "Roughness"), ("metallic", "Metallic"), ("specular", "Specular")):
            shader.inputs[theirs].default_value = m[ours]
        shader.inputs["Sheen Tint"].default_value = 0
    elif m["type"] == "hair":
        shader = nodes.new("ShaderNodeBsdfHairPrincipled")
        shader.parametrization = "ABSORPTION"
        shader.inputs["Absorption Coefficient"].default_value = m["sigma_a"]
        for ours, theirs in (("beta_m", "Roughness"), ("beta_n", "Radial Roughness"), ("alpha", "Offset"),
                             ("ior", "IOR")):
            shader.inputs[theirs].default_value = m[ours]
        for name in ("Coat", "Random Color", "Random Roughness"):
            shader.inputs[name].default_value = 0
    else:
        shader = nodes.new("ShaderNodeBsdfDiffuse")
        shader.inputs["Color"].default_value = (*m["diffuse"], 1)
        shader.inputs["Roughness"].default_value = 0  # Lambert
    surface = shader.outputs[0]
    if any(m["emission"]):
        # What shines is an area lamp before this surface (below), of which Cycles makes slightly less noise than
        # of a shining mesh (relMSE x spp 0.114 instead of 0.116); the camera alone sees this surface shine.
        emission = nodes.new("ShaderNodeEmission")
        emission.inputs["Color"].default_value = (*m["emission"], 1)
        path = nodes.new("ShaderNodeLightPath")
        links.new(path.outputs["Is Camera Ray"], emission.inputs["Strength"])
        total = nodes.new("ShaderNodeAddShader")
        links.new(surface, total.inputs[0])
        links.new(emission.outputs[0], total.inputs[1])
        surface = total.outputs[0]
        material.cycles.sample_as_light = False
    links.new(surface, output.inputs["Surface"])
    return material


def raw(name, kind):
    values = array.array(kind)
    path = os.path.join(folder, name)
    with open(path, "rb") as f:
        values.fromfile(f, os.path.getsize(path) // values.itemsize)
    return values


def raw_points(name):
    points = raw(name, "f")
    points[0::3], points[1::3], points[2::3] = points[2::3], points[0::3], points[1::3]  # turned()
    return points


def make_mesh(m):
    vertices, corners = raw_points(m["vertices"]), raw(m["triangles"], "i")
    mesh = bpy.data.meshes.new("mesh")
    mesh.vertices.add(len(vertices) // 3)
    mesh.vertices.foreach_set("co", vertices)
    mesh.loops.add(len(corners))
    mesh.loops.foreach_set("vertex_index", corners)
    mesh.polygons.add(len(corners) // 3)
    mesh.polygons.foreach_set("loop_start", array.array("i", range(0, len(corners), 3)))
    mesh.polygons.foreach_set("loop_total", array.array("i", [3]) * (len(corners) // 3))
    mesh.materials.append(materials[m["material"]])
    mesh.update()
    show(mesh)


def make_curves(c):
    # Python cannot fill hair curves in this version of Blender: a mesh of edges becomes curves by geometry nodes.
    points, radii, counts = raw_points(c["points"]), raw(c["radii"], "f"), raw(c["counts"], "i")
    edges, first = array.array("i"), 0
    for count in counts:
        for i in range(first, first + count - 1):
            edges.extend((i, i + 1))
        first += count
    mesh = bpy.data.meshes.new("strands")
    mesh.vertices.add(len(radii))
    mesh.vertices.foreach_set("co", points)
    mesh.edges.add(len(edges) // 2)
    mesh.edges.foreach_set("vertices", edges)
    mesh.attributes.new("strand_radius", "FLOAT", "POINT").data.foreach_set("value", radii)
    mesh.update()
    source = show(mesh, "strands")
    source.hide_render = True

    group = bpy.data.node_groups.new("strands", "GeometryNodeTree")
    group.outputs.new("NodeSocketGeometry", "Geometry")
    nodes, links = group.nodes, group.links
    info, to_curve = nodes.new("GeometryNodeObjectInfo"), nodes.new("GeometryNodeMeshToCurve")
    named, radius = nodes.new("GeometryNodeInputNamedAttribute"), nodes.new("GeometryNodeSetCurveRadius")
    material, output = nodes.new("GeometryNodeSetMaterial"), nodes.new("NodeGroupOutput")
    info.inputs["Object"].default_value = source
    named.data_type = "FLOAT"
    named.inputs["Name"].default_value = "strand_radius"
    material.inputs["Material"].default_value = materials[c["material"]]
    links.new(info.outputs["Geometry"], to_curve.inputs["Mesh"])
    links.new(to_curve.outputs["Curve"], radius.inputs["Curve"])
    links.new(next(o for o in named.outputs if o.enabled), radius.inputs["Radius"])
    links.new(radius.outputs["Curve"], material.inputs["Geometry"])
    links.new(material.outputs["Geometry"], output.inputs[0])
    curves = show(bpy.data.hair_curves.new("hair"), "hair")
    curves.modifiers.new("strands", "NODES").node_group = group
    scene.cycles_curves.shape = "THICK"


def make_lamp(kind, center, radiance, energy_per_radiance):
    lamp = bpy.data.lights.new("lamp", kind)
    largest = max(radiance)
    lamp.color = [c / largest for c in radiance]
    lamp.energy = largest * energy_per_radiance
    lamp.cycles.use_multiple_importance_sampling = True
    lamp.cycles.max_bounces = 1024
    thing = show(lamp, "lamp")
    thing.location = center
    return lamp, thing


def make_ball_lamp(b):
    r = b["radius"]
    lamp, _ = make_lamp("POINT", turned(b["center"]), b["radiance"], 4 * math.pi**2 * r**2)
    lamp.shadow_soft_size = r


def make_rectangle_lamp(b):
    x, y = turned(b["x"]), turned(b["y"])
    normal = x.cross(y).normalized()
    # Before the surface by a little, which must not shadow it.
    center = turned(b["center"]) + 1e-4 * max(x.length, y.length) * normal
    lamp, thing = make_lamp("AREA", center, b["radiance"], 4 * 4 * x.length * y.length)
    lamp.shape = "RECTANGLE"
    lamp.size, lamp.size_y = 2 * x.length, 2 * y.length
    lamp.spread = math.pi
    across = x.normalized()
    rotation = mathutils.Matrix((across, (-normal).cross(across), -normal)).transposed()  # it shines along -z
    thing.matrix_world = mathutils.Matrix.Translation(center) @ rotation.to_4x4()


def make_world():
    world = bpy.data.worlds.new("world")
    scene.world = world
    world.use_nodes = True
    nodes, links = nodes_of(world.node_tree)
    output, background = nodes.new("ShaderNodeOutputWorld"), nodes.new("ShaderNodeBackground")
    links.new(background.outputs[0], output.inputs["Surface"])
    background.inputs["Color"].default_value = (0, 0, 0, 1)
    if "panorama" in description:
        texture = nodes.new("ShaderNodeTexEnvironment")
        texture.image = bpy.data.images.load(os.path.join(folder, description["panorama"]))
        texture.image.colorspace_settings.name = "Linear"
        texture.interpolation = "Linear"
        links.new(texture.outputs["Color"], background.inputs["Color"])
        world.cycles.sampling_method = "AUTOMATIC"  # a map twice as fine as the picture, better than as fine
        world.cycles.max_bounces = 1024


def make_camera(c):
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit = "VERTICAL"
    camera.angle_y = c["vertical_fov"]
    camera.clip_start, camera.clip_end = 1e-3, 1e6
    thing = show(camera, "camera")
    position = turned(c["position"])
    backward = (position - turned(c["target"])).normalized()
    right = turned(c["up"]).cross(backward).normalized()
    rotation = mathutils.Matrix((right, backward.cross(right), backward)).transposed()
    thing.matrix_world = mathutils.Matrix.Translation(position) @ rotation.to_4x4()
    scene.camera = thing


def set_up_rendering():
    scene.render.engine = "CYCLES"
    scene.render.resolution_x, scene.render.resolution_y = description["width"], description["height"]
    scene.render.resolution_percentage = 100
    scene.render.use_persistent_data = True  # the BVH outlives a render
    scene.render.use_compositing = scene.render.use_sequencer = False
    scene.render.dither_intensity = 0
    image = scene.render.image_settings
    image.file_format, image.color_mode, image.color_depth, image.exr_codec = "OPEN_EXR", "RGB", "32", "ZIP"
    scene.view_settings.view_transform = "Raw"
    settings = {
        "device": "CPU",
        "feature_set": "SUPPORTED",
        # Unlimited depth, or as good as that; when Russian roulette starts is Cycles' own default.
        **{name: 1024 for name in ("max_bounces", "diffuse_bounces", "glossy_bounces", "transmission_bounces",
                                   "volume_bounces", "transparent_max_bounces")},
        # Nothing that biases.
        "sample_clamp_direct": 0, "sample_clamp_indirect": 0, "blur_glossy": 0, "light_sampling_threshold": 0,
        "caustics_reflective": True, "caustics_refractive": True, "use_fast_gi": False,
        "use_adaptive_sampling": False, "use_denoising": False, "use_guiding": False, "time_limit": 0,
        "film_exposure": 1, "pixel_filter_type": "BOX", "filter_width": 1,
        "use_auto_tile": False,  # one tile, the image
        "use_animated_seed": False,
        # Of the two, SOBOL leaves as much noise (relMSE x spp at 64 spp: 0.114, 0.094, 0.067 instead of 0.114,
        # 0.094, 0.070 in the scenes' order) and is not the default.
        "sampling_pattern": "PROGRESSIVE_MULTI_JITTER",
    }
    for name, value in settings.items():
        setattr(scene.cycles, name, value)
    for override in overrides:
        name, text = override.split("=", 1)
        kind = type(getattr(scene.cycles, name))
        setattr(scene.cycles, name, text in ("1", "true", "True") if kind is bool else kind(text))


def seconds_of(path):
    """What Cycles wrote into the picture: the time without the scene's synchronisation and BVH."""
    with open(path, "rb") as f:
        header = f.read(65536)
    key = b"cycles.ViewLayer.render_time\0string\0"
    start = header.index(key) + len(key)
    (length,) = struct.unpack_from("<i", header, start)
    text = header[start + 4:start + 4 + length].decode()
    seconds = 0.0
    for part in text.split(":"):
        seconds = 60 * seconds + float(part)
    return seconds


scene = bpy.data.scenes.new("versus")
for other in [s for s in bpy.data.scenes if s != scene]:
    bpy.data.scenes.remove(other)
materials = [make_material(m) for m in description["materials"]]
for m in description["meshes"]:
    make_mesh(m)
for c in description["curves"]:
    make_curves(c)
for b in description["ball_lamps"]:
    make_ball_lamp(b)
for b in description["rectangle_lamps"]:
    make_rectangle_lamp(b)
make_world()
make_camera(description["camera"])
set_up_rendering()
print("versus_cycles ready", bpy.app.version_string, flush=True)
for line in sys.stdin:
    seed, spp, path = line.split(None, 2)
    scene.cycles.seed, scene.cycles.samples = int(seed), int(spp)
    scene.render.filepath = path.strip()
    bpy.ops.render.render(write_still=True, scene=scene.name)
    print("versus_cycles rendered", seconds_of(scene.render.filepath), flush=True)

"""Shows what `talus export RUN --npz pile.npz` wrote in Blender 3.4 or newer, also many thousands of bodies.

    blender --python blender_import.py -- pile.npz

One mesh has a point for each body; Geometry Nodes put an instance of the body's shape at each. A handler moves the points
when the frame changes, so a file that is saved needs this script, which it holds as a text, run again. The attributes
"shape", "asleep" and "cause" of the points are there for materials and other nodes.
"""

import sys

import bpy
import numpy

AWAKE, ASLEEP = (0.90, 0.42, 0.06, 1.0), (0.025, 0.027, 0.033, 1.0)  # linear, as in the pictures


def material():
    """Orange where the attribute "asleep" of an instance is 0, black where it is 1."""
    made = bpy.data.materials.new("talus body")
    made.use_nodes = True
    nodes, links = made.node_tree.nodes, made.node_tree.links
    asleep = nodes.new("ShaderNodeAttribute")
    asleep.attribute_type, asleep.attribute_name = "INSTANCER", "asleep"
    mix = nodes.new("ShaderNodeMixRGB")
    mix.inputs["Color1"].default_value, mix.inputs["Color2"].default_value = AWAKE, ASLEEP
    links.new(asleep.outputs["Fac"], mix.inputs["Fac"])
    links.new(mix.outputs["Color"], nodes["Principled BSDF"].inputs["Base Color"])
    return made


def shape_collection(run):
    """An object for each shape, in a collection that is not shown itself; instances are picked by name."""
    collection = bpy.data.collections.new("talus shapes")
    paint = material()
    for shape, name in enumerate(run["shape_name"]):
        triangles = run["mesh_triangle"][run["mesh_shape"] == shape]
        used, corners = numpy.unique(triangles, return_inverse=True)
        mesh = bpy.data.meshes.new(name.decode())
        mesh.from_pydata(run["mesh_vertex"][used].tolist(), [], corners.reshape(-1, 3).tolist())
        mesh.materials.append(paint)
        collection.objects.link(bpy.data.objects.new(f"{shape:04} {name.decode()}", mesh))
    return collection


def instancing_nodes(collection):
    """Geometry Nodes: at each point the shape of its number, turned and shown as its attributes say."""
    tree = bpy.data.node_groups.new("talus bodies", "GeometryNodeTree")
    if hasattr(tree, "interface"):  # Blender 4
        tree.interface.new_socket("Geometry", in_out="INPUT", socket_type="NodeSocketGeometry")
        tree.interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
    else:
        tree.inputs.new("NodeSocketGeometry", "Geometry")
        tree.outputs.new("NodeSocketGeometry", "Geometry")
    node, link = tree.nodes.new, tree.links.new

    def attribute(name, kind):
        named = node("GeometryNodeInputNamedAttribute")
        named.data_type = kind
        named.inputs["Name"].default_value = name
        return next(socket for socket in named.outputs if socket.enabled and socket.name == "Attribute")

    shapes = node("GeometryNodeCollectionInfo")
    shapes.inputs["Collection"].default_value = collection
    shapes.inputs["Separate Children"].default_value = True
    shapes.inputs["Reset Children"].default_value = True
    place = node("GeometryNodeInstanceOnPoints")
    place.inputs["Pick Instance"].default_value = True
    link(node("NodeGroupInput").outputs[0], place.inputs["Points"])
    link(next(socket for socket in shapes.outputs if socket.type == "GEOMETRY"), place.inputs["Instance"])
    link(attribute("shape", "INT"), place.inputs["Instance Index"])
    link(attribute("turn", "FLOAT_VECTOR"), place.inputs["Rotation"])
    link(attribute("size", "FLOAT"), place.inputs["Scale"])
    link(place.outputs["Instances"], node("NodeGroupOutput").inputs[0])
    return tree


def positions(run, frame):
    at = run["position"][frame]
    if at.shape[1] == 3:
        return at
    return numpy.stack([at[:, 0], numpy.zeros(len(at)), at[:, 1]], axis=1)  # 2D: in the plane y = 0


def euler(run, frame):
    """Rotations as angles about x, y and z, in this order, in radians."""
    turn = run["rotation"][frame].astype(float)
    if turn.shape[1] == 1:
        return numpy.stack([0 * turn[:, 0], -turn[:, 0], 0 * turn[:, 0]], axis=1)
    w, x, y, z = (turn / numpy.linalg.norm(turn, axis=1, keepdims=True)).T
    return numpy.stack([numpy.arctan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
                        numpy.arcsin(numpy.clip(2 * (w * y - z * x), -1, 1)),
                        numpy.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))], axis=1)


def point_object(run, collection):
    count = len(run["shape"])
    mesh = bpy.data.meshes.new("talus bodies")
    mesh.vertices.add(count)
    for name, kind in (("shape", "INT"), ("cause", "INT"), ("turn", "FLOAT_VECTOR"), ("size", "FLOAT"), ("asleep", "FLOAT")):
        mesh.attributes.new(name, kind, "POINT")
    mesh.attributes["shape"].data.foreach_set("value", numpy.maximum(run["shape"], 0).astype(numpy.int32))
    made = bpy.data.objects.new("talus bodies", mesh)
    bpy.context.scene.collection.objects.link(made)
    modifier = made.modifiers.new("talus", "NODES")
    modifier.node_group = instancing_nodes(collection)
    return made


def load(path):
    run = dict(numpy.load(path))
    bodies = point_object(run, shape_collection(run))
    scene = bpy.context.scene
    time = run["time"] - run["time"][0]
    scene.frame_start, scene.frame_end = 1, 1 + int(time[-1] * scene.render.fps)

    def show(scene, *_):
        frame = int(numpy.searchsorted(time, (scene.frame_current - 1) / scene.render.fps + 1e-6, side="right")) - 1
        frame = max(0, min(frame, len(time) - 1))
        mesh = bodies.data
        mesh.vertices.foreach_set("co", positions(run, frame).astype(numpy.float32).ravel())
        mesh.attributes["turn"].data.foreach_set("vector", euler(run, frame).astype(numpy.float32).ravel())
        mesh.attributes["size"].data.foreach_set("value", run["present"][frame].astype(numpy.float32))
        mesh.attributes["asleep"].data.foreach_set("value", run["asleep"][frame].astype(numpy.float32))
        mesh.attributes["cause"].data.foreach_set("value", run["cause"][frame].astype(numpy.int32))
        mesh.update()

    bpy.app.handlers.frame_change_pre.append(show)
    scene.frame_set(1)
    return bodies


if __name__ == "__main__":
    if "--" not in sys.argv:
        sys.exit(__doc__)
    load(sys.argv[sys.argv.index("--") + 1])

"""The same small room in every file format, undamaged, for tests that damage the files."""
import base64
import io
import json
import struct
import zipfile
import zlib

CORNERS = [(x, y, z) for z in (0, 3) for y in (0, 4) for x in (0, 5)]
QUADS = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
TRIANGLES = [t for a, b, c, d in QUADS for t in ((a, b, c), (a, c, d))]


def png(width=4, height=4):
    rows = b"".join(b"\0" + bytes([200, 150, 100] * width) for _ in range(height))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(
            ">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) +
            chunk(b"IEND", b""))


def obj():
    lines = ["mtllib room.mtl", "o room"]
    lines += ["v %g %g %g" % c for c in CORNERS] + ["vt 0 0", "vt 1 0", "vt 1 1", "vn 0 0 1"]
    lines += ["usemtl oak"] + ["f " + " ".join(f"{v + 1}/1/1" for v in q) for q in QUADS]
    return "\n".join(lines).encode() + b"\n"


def mtl():
    return b"newmtl oak\nKd 0.5 0.4 0.3\nNs 10\nd 1\nmap_Kd oak.png\n"


def ply(form="ascii"):
    head = (f"ply\nformat {form} 1.0\ncomment a room\nelement vertex {len(CORNERS)}\n"
            "property float x\nproperty float y\nproperty float z\n"
            f"element face {len(TRIANGLES)}\nproperty list uchar int vertex_indices\nend_header\n")
    if form == "ascii":
        body = "".join("%g %g %g\n" % c for c in CORNERS)
        body += "".join("3 %d %d %d\n" % t for t in TRIANGLES)
        return (head + body).encode()
    end = "<" if "little" in form else ">"
    body = b"".join(struct.pack(end + "3f", *c) for c in CORNERS)
    return head.encode() + body + b"".join(struct.pack(end + "B3i", 3, *t) for t in TRIANGLES)


def stl(text=False):
    if text:
        facets = "".join("facet normal 0 0 1\nouter loop\n" +
                         "".join("vertex %g %g %g\n" % CORNERS[v] for v in t) +
                         "endloop\nendfacet\n" for t in TRIANGLES)
        return f"solid room\n{facets}endsolid room\n".encode()
    body = b"".join(struct.pack("<12fH", 0, 0, 1, *(x for v in t for x in CORNERS[v]), 0)
                    for t in TRIANGLES)
    return b"\0" * 80 + struct.pack("<I", len(TRIANGLES)) + body


def gltf_json(uri=None):
    points = b"".join(struct.pack("<3f", *c) for c in CORNERS)
    indices = b"".join(struct.pack("<3H", *t) for t in TRIANGLES)
    image = png()
    image_at = len(points) + len(indices)
    data = points + indices + image
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "room", "children": [1]}, {"name": "box", "mesh": 0}],
        "meshes": [{"name": "box", "primitives": [
            {"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "textures": [{"source": 0}],
        "images": [{"bufferView": 2, "mimeType": "image/png"}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3",
             "min": [0, 0, 0], "max": [5, 4, 3]},
            {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteLength": len(points)},
                        {"buffer": 0, "byteOffset": len(points), "byteLength": len(indices)},
                        {"buffer": 0, "byteOffset": image_at, "byteLength": len(image)}],
        "buffers": [{"byteLength": len(data)}]}
    if uri is not None:
        document["buffers"][0]["uri"] = uri
    return document, data


def gltf():
    document, data = gltf_json()
    document["buffers"][0]["uri"] = ("data:application/octet-stream;base64," +
                                     base64.b64encode(data).decode())
    return json.dumps(document).encode()


def container(document, data):
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    data += b"\0" * (-len(data) % 4)
    size = 12 + 8 + len(text) + 8 + len(data)
    return (struct.pack("<4sII", b"glTF", 2, size) + struct.pack("<I4s", len(text), b"JSON") +
            text + struct.pack("<I4s", len(data), b"BIN\0") + data)


def glb():
    return container(*gltf_json())


# The room as compressed by the encoders of Draco 1.5.5 and meshoptimizer 0.18.
DRACO = bytes.fromhex(
    "445241434f02020101000000080c000b0000035f4b1501011001ff000001000903000002010101000c0301101f011"
    "00120040048ee830000c09903981900006806000034433304103334030000403300000000ff070000000000000000"
    "0000000000000000a0400b")
DRACO_SEQUENTIAL = bytes.fromhex(
    "445241434f0202010000000c080100010300030204060704070500040500050102030702070600020600060401050"
    "701070301010009030000000000000000000000000000000000a04000000000000000000000000000008040000000"
    "000000a04000008040000000000000000000000000000040400000a0400000000000004040000000000000804000"
    "0040400000a0400000804000004040")
MESHOPT_CORNERS = bytes.fromhex(  # in thousandths, as four 16-bit integers
    "a0013fff0000eff0eff0eff0ef013fff000026252625262526010ccc0000bfc0bf010ccc00001e1d1e0100c000008"
    "f0100c000001600000000000000000000000000000000000000000000000000000000000000000000")
MESHOPT_TRIANGLES = bytes.fromhex(
    "e0fe00ff0f0716a102071391050f06ff02040203007687566778a9866589689801690000")


def draco(packed=DRACO):
    document, _ = gltf_json()
    document["accessors"] = [{"componentType": 5126, "count": 8, "type": "VEC3"},
                             {"componentType": 5125, "count": 36, "type": "SCALAR"}]
    document["bufferViews"] = [{"buffer": 0, "byteLength": len(packed)}]
    document["buffers"][0]["byteLength"] = len(packed)
    for unused in ("materials", "textures", "images"):
        del document[unused]
    document["meshes"][0]["primitives"] = [
        {"attributes": {"POSITION": 0}, "indices": 1, "extensions": {
            "KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}}}]
    document["extensionsRequired"] = ["KHR_draco_mesh_compression"]
    return container(document, packed)


def meshopt(corners=8):
    """A glTF file with meshoptimizer compression, quantised positions and one instance."""
    place = struct.pack("<3f", 1, 2, 3)
    data = b""
    views = []
    for packed, count, stride, mode in ((MESHOPT_CORNERS, corners, 8, "ATTRIBUTES"),
                                        (MESHOPT_TRIANGLES, 36, 2, "TRIANGLES")):
        views.append({"buffer": 1, "byteLength": count * stride, "extensions": {
            "EXT_meshopt_compression": {
                "buffer": 0, "byteOffset": len(data), "byteLength": len(packed), "count": count,
                "byteStride": stride, "mode": mode}}})
        data += packed + b"\0" * (-len(packed) % 4)
    views[0]["byteStride"] = 8
    views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(place)})
    data += place
    document, _ = gltf_json()
    document.update({
        "bufferViews": views,
        "buffers": [{"byteLength": len(data)}, {"byteLength": 136}],
        "accessors": [
            {"bufferView": 0, "componentType": 5122, "count": 8, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"},
            {"bufferView": 2, "componentType": 5126, "count": 1, "type": "VEC3"}],
        "nodes": [{"name": "room", "children": [1]},
                  {"name": "box", "mesh": 0, "scale": [0.001, 0.001, 0.001], "extensions": {
                      "EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 2}}}}],
        "extensionsRequired": ["EXT_meshopt_compression", "KHR_mesh_quantization",
                               "EXT_mesh_gpu_instancing"]})
    for unused in ("materials", "textures", "images"):
        del document[unused]
    document["meshes"][0]["primitives"] = [{"attributes": {"POSITION": 0}, "indices": 1}]
    return container(document, data)


def dae():
    numbers = " ".join("%g %g %g" % c for c in CORNERS)
    indices = " ".join("%d %d %d" % t for t in TRIANGLES)
    return f"""<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="meter" meter="1"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g" name="room"><mesh>
<source id="p"><float_array id="a" count="24">{numbers}</float_array><technique_common>
<accessor source="#a" count="8" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="12"><input semantic="VERTEX" source="#v" offset="0"/><p>{indices}</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n" name="room">
<instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>
""".encode()


def _fbx_node(name, values=(), children=(), at=0):
    """One node of a binary FBX 7.4 file that begins at byte `at`."""
    data = b""
    for value in values:
        if isinstance(value, bytes):
            data += b"S" + struct.pack("<I", len(value)) + value
        elif isinstance(value, int):
            version = name.endswith("Version")
            data += b"I" + struct.pack("<i", value) if version else (
                b"L" + struct.pack("<q", value))
        elif isinstance(value, list):
            kind, code = ("d", "d") if isinstance(value[0], float) else ("i", "i")
            packed = zlib.compress(struct.pack(f"<{len(value)}{code}", *value))
            data += kind.encode() + struct.pack("<III", len(value), 1, len(packed)) + packed
        else:
            data += b"D" + struct.pack("<d", value)
    head = 13 + len(name)
    inside = b""
    for child in children:
        inside += _fbx_node(*child, at=at + head + len(data) + len(inside))
    if children:
        inside += b"\0" * 13
    end = at + head + len(data) + len(inside)
    return (struct.pack("<IIIB", end, len(values), len(data), len(name)) + name.encode() + data +
            inside)


def fbx():
    points = [float(x) for c in CORNERS for x in c]
    indices = [i for t in TRIANGLES for i in (t[0], t[1], ~t[2])]
    setting = ("P", (b"UnitScaleFactor", b"double", b"Number", b"", 100.0))
    tree = [
        ("FBXHeaderExtension", (), [("FBXVersion", (7400,))]),
        ("GlobalSettings", (), [("Version", (1000,)), ("Properties70", (), [setting])]),
        ("Objects", (), [
            ("Geometry", (1, b"box\0\1Geometry", b"Mesh"),
             [("Vertices", (points,)), ("PolygonVertexIndex", (indices,))]),
            ("Model", (2, b"room\0\1Model", b"Mesh"), [("Version", (232,))])]),
        ("Connections", (), [("C", (b"OO", 1, 2)), ("C", (b"OO", 2, 0))])]
    data = b"Kaydara FBX Binary  \0\x1a\0" + struct.pack("<I", 7400)
    for node in tree:
        data += _fbx_node(*node, at=len(data))
    return data + b"\0" * 13


SEEDS = {"room.obj": obj, "ascii.ply": ply, "little.ply": lambda: ply("binary_little_endian"),
         "big.ply": lambda: ply("binary_big_endian"), "room.stl": stl,
         "text.stl": lambda: stl(True), "room.gltf": gltf, "room.glb": glb, "draco.glb": draco,
         "sequential.glb": lambda: draco(DRACO_SEQUENTIAL), "meshopt.glb": meshopt,
         "room.dae": dae, "room.fbx": fbx}


def front3d():
    """A 3D-FRONT house whose only piece of furniture is the room; it has its own floor, too."""
    return json.dumps({
        "uid": "house", "north_vector": [0, 0, -1],
        "furniture": [{"uid": "1/model", "jid": "abc", "category": "Others", "valid": True}],
        "mesh": [{"uid": "m/0", "jid": "", "type": "Floor", "material": "paint",
                  "xyz": [0, 0, 0, 6, 0, 0, 6, 0, 5, 0, 0, 5], "normal": [], "uv": [],
                  "faces": [0, 2, 1, 0, 3, 2]}],
        "material": [{"uid": "paint", "jid": "oak", "texture": "", "color": [255, 0, "128", 255],
                      "UVTransform": [0, 2, 0, -3, 0, 0, 0, 0, 1]}],
        "scene": {"room": [{"type": "Bedroom", "instanceid": "Bedroom-1", "children": [
            {"ref": "1/model", "pos": [2, 0, 3], "rot": [0, 0, 0, 1], "scale": [1, 1, 1]}]}]},
    }).encode()


def scenenet():
    return b"""layout_file: ./office/layout.obj
object
03928116/aaa
wnid
03928116
scale
1.6
transformation
1.000 0.000 0.000 1.0
0.000 1.000 0.000 0.5
0.000 0.000 1.000 2.0
end
"""


def home_xml():
    return b"""<?xml version='1.0'?>
<home version='7000' name='flat.sh3d' wallHeight='250.0'>
<observerCamera attribute='storedCamera' name='Door' x='60' y='60' z='150' yaw='-0.8' pitch='0.2'
 fieldOfView='1.1'/>
<wall id='a' wallAtEnd='b' xStart='0' yStart='0' xEnd='400' yEnd='0' height='250' thickness='10'/>
<wall id='b' wallAtStart='a' xStart='400' yStart='0' xEnd='400' yEnd='300' height='250'
 thickness='10'/>
<room name='Hall'><point x='5' y='5'/><point x='395' y='5'/><point x='395' y='295'/>
<texture attribute='floorTexture' name='Tiles' width='20' height='20' image='oak.png'/></room>
<doorOrWindow name='Window' model='room.obj' x='200' y='0' elevation='90' width='80' depth='10'
 height='100' cutOutShape='M0,0 v1 h1 v-1 z' wallThickness='1'/>
<pieceOfFurniture name='Box' model='room.obj' x='200' y='150' width='120' depth='80' height='75'/>
</home>
"""


def sh3d():
    """A Sweet Home 3D archive, stored uncompressed so that damage affects its content."""
    bytes_ = io.BytesIO()
    with zipfile.ZipFile(bytes_, "w", zipfile.ZIP_STORED) as out:
        for name, data in (("Home.xml", home_xml()), ("room.obj", obj()), ("room.mtl", mtl()),
                           ("oak.png", png())):
            out.writestr(name, data)
    return bytes_.getvalue()


def hdf5(*numbers):
    """An HDF5 file with one dataset of this name, as Hypersim writes them."""
    import h5py
    bytes_ = io.BytesIO()
    with h5py.File(bytes_, "w") as file:
        file.create_dataset("dataset", data=numbers, dtype="int32")
    return bytes_.getvalue()


def scene_instance():
    """A Habitat scene instance: a room as the stage, with a box and a drawer in it."""
    return json.dumps({
        "stage_instance": {"template_name": "room"}, "semantic_scene_instance": "words",
        "object_instances": [
            {"template_name": "chair", "translation": [2, 1, -1], "rotation": [1, 0, 0, 0],
             "translation_origin": "asset_local", "uniform_scale": 0.25}],
        "articulated_object_instances": [
            {"template_name": "drawer", "translation": [3, 1, -3], "uniform_scale": 0.5}]}).encode()


def dataset_config():
    return json.dumps({
        "stages": {"paths": {".json": ["stages"]}},
        "objects": {"paths": {".json": ["objects/*"]}, "configs": [
            {"original_file": "objects/chair.object_config.json", "template_handle": "small",
             "attributes": {"scale": [0.5, 0.5, 0.5]}}]},
        "articulated_objects": {"paths": {".urdf": ["urdf"]}},
        "scene_instances": {"paths": {".json": ["scenes"]}},
        "semantic_scene_descriptor_instances": {"words": "words.json"}}).encode()


def object_config():
    return b'{"render_asset": "../room.obj", "semantic_id": 5, "up": [0, 0, 1], "front": [0, 1, 0]}'


def urdf():
    return b"""<robot name="drawer"><material name="oak"><color rgba="0.6 0.4 0.3 1"/></material>
<link name="body"><visual><geometry><box size="1 1 1"/></geometry><material name="oak"/></visual></link>
<joint name="rail" type="prismatic"><origin xyz="0 0 0.4" rpy="0 0 1.57"/><parent link="body"/>
<child link="front"/></joint>
<link name="front"><visual><geometry><mesh filename="../room.obj" scale="0.2 0.2 0.2"/></geometry>
</visual></link></robot>"""


def world():
    return b"""<?xml version="1.0"?><sdf version="1.7"><world name="flat">
<include><uri>model://hall</uri></include>
<model name="table"><pose degrees="true">2 2 0 0 0 90</pose><link name="top"><visual name="v">
<pose>0 0 0.7 0 0 0</pose><geometry><box><size>1 0.6 0.04</size></box></geometry>
<material><diffuse>0.5 0.3 0.2 1</diffuse></material></visual></link>
<link name="foot"><visual name="v"><geometry><cylinder><radius>0.1</radius><length>1.4</length>
</cylinder></geometry><material><script><uri>model://hall/materials/scripts</uri><name>oak</name>
</script></material></visual></link>
<joint name="screw" type="fixed"><parent>top</parent><child>foot</child></joint></model>
</world></sdf>"""


def hall():
    return b"""<sdf version="1.6"><model name="hall"><link name="link"><visual name="v"><geometry><mesh>
<uri>model://hall/meshes/room.obj</uri><scale>1 1 1</scale></mesh></geometry></visual></link></model></sdf>"""


def material_script():
    return b"""material wood { technique { pass { diffuse 0.5 0.4 0.3 1 } } }
material oak : wood // a picture
{ technique { pass { texture_unit { texture oak.png
scale 2 2 } } } }
"""


def labelled_ply(form="ascii"):
    """The room as a PLY file whose faces have object ids; each side is one object."""
    head = (f"ply\nformat {form} 1.0\nelement vertex {len(CORNERS)}\n"
            "property float x\nproperty float y\nproperty float z\n"
            f"element face {len(TRIANGLES)}\nproperty list uchar int vertex_indices\n"
            "property int object_id\nend_header\n").encode()
    if form == "ascii":
        lines = ["%g %g %g" % c for c in CORNERS]
        lines += ["3 %d %d %d %d" % (*t, i // 2) for i, t in enumerate(TRIANGLES)]
        return head + "\n".join(lines).encode() + b"\n"
    body = b"".join(struct.pack("<3f", *c) for c in CORNERS)
    return head + body + b"".join(struct.pack("<B4i", 3, *t, i // 2)
                                  for i, t in enumerate(TRIANGLES))


SIDES = ["floor", "ceiling", "wall", "wall", "wall", "wall"]


def semantic_info():
    return json.dumps({"objects": [{"id": i, "class_id": 1, "class_name": name}
                                   for i, name in enumerate(SIDES)]}).encode()


def house():
    lines = ["ASCII 1.1"] + [f"C {i} {i} {name} 3 {name} 0 0" for i, name in enumerate(SIDES)]
    return "\n".join(lines + [f"O {i} 0 {i} 1 2 3" for i in range(len(SIDES))]).encode() + b"\n"


def segments():
    return json.dumps({"segIndices": [0, 0, 0, 0, 1, 1, 1, 1]}).encode()


def aggregation():
    return json.dumps({"segGroups": [{"objectId": 1, "segments": [0], "label": "floor"},
                                     {"objectId": 2, "segments": [1], "label": "ceiling"}]}).encode()


def write_beside(folder):
    """Writes the other files that the scenes below need."""
    for name, data in {
            "room.obj": obj(), "room.mtl": mtl(), "oak.png": png(), "office/layout.obj": obj(),
            "3D-FUTURE-model/abc/raw_model.obj": obj(), "3D-FRONT-texture/oak/texture.png": png(),
            "ShapeNetCore.v2/03928116/aaa/models/model_normalized.obj": obj(),
            "ai/room.obj": obj(), "ai/room.mtl": mtl(),
            "ai/_detail/mesh/metadata_objects.csv": b"object_name\nroom\nroom_2\n",
            "ai/_detail/metadata_scene.csv": b"name,value\nmeters_per_asset_unit,0.9\n",
            "ai/_detail/mesh/mesh_objects_si.hdf5": hdf5(4, 5),
            "ai/_detail/mesh/mesh_objects_sii.hdf5": hdf5(1, 2),
            "hab/room.obj": obj(), "hab/room.mtl": mtl(), "hab/oak.png": png(),
            "hab/set.scene_dataset_config.json": dataset_config(),
            "hab/words.json": b'{"classes": [{"id": 5, "name": "chair"}]}',
            "hab/stages/room.stage_config.json":
                b'{"render_asset": "../room.obj", "up": [0, 0, 1], "front": [0, 1, 0]}',
            "hab/objects/chair.object_config.json": object_config(),
            "hab/urdf/drawer.urdf": urdf(), "hab/scenes/flat.scene_instance.json": scene_instance(),
            "gz/flat.world": world(), "gz/models/hall/model.sdf": hall(),
            "gz/models/hall/meshes/room.obj": obj(), "gz/models/hall/meshes/room.mtl": mtl(),
            "gz/models/hall/meshes/oak.png": png(),
            "gz/models/hall/materials/scripts/hall.material": material_script(),
            "gz/models/hall/materials/textures/oak.png": png(),
            "replica/mesh_semantic.ply": labelled_ply(),
            "replica/info_semantic.json": semantic_info(),
            "mp3d/a_semantic.ply": labelled_ply("binary_little_endian"), "mp3d/a.house": house(),
            "scannet/s_vh_clean_2.ply": ply(), "scannet/s.aggregation.json": aggregation(),
            "scannet/s_vh_clean_2.0.010000.segs.json": segments()}.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)


# The damaged file, its bytes, the file to open (empty: the same), the number of triangles of the
# undamaged scene.
SCENES = [
    ("house.json", front3d, None, 14), ("scene.txt", scenenet, None, 24),
    ("Home.xml", home_xml, None, None), ("flat.sh3d", sh3d, None, None),
    ("ai/_detail/mesh/metadata_objects.csv", lambda: b"object_name\nroom\n\"room 2\"\n",
     "ai/room.obj", 12),
    ("ai/_detail/mesh/mesh_objects_si.hdf5", lambda: hdf5(4, 5), "ai/room.obj", 12)]
FLAT = "hab/scenes/flat.scene_instance.json"
SCENES += [
    (FLAT, scene_instance, FLAT, 48),
    ("hab/set.scene_dataset_config.json", dataset_config, FLAT, 48),
    ("hab/objects/chair.object_config.json", object_config, FLAT, 48),
    ("hab/urdf/drawer.urdf", urdf, FLAT, 48),
    ("gz/flat.world", world, "gz/flat.world", None),
    ("gz/models/hall/model.sdf", hall, "gz/flat.world", None),
    ("gz/models/hall/materials/scripts/hall.material", material_script, "gz/flat.world", None),
    ("replica/mesh_semantic.ply", labelled_ply, "replica/mesh_semantic.ply", 12),
    ("replica/info_semantic.json", semantic_info, "replica/mesh_semantic.ply", 12),
    ("mp3d/a_semantic.ply", lambda: labelled_ply("binary_little_endian"), "mp3d/a_semantic.ply", 12),
    ("mp3d/a.house", house, "mp3d/a_semantic.ply", 12),
    ("scannet/s.aggregation.json", aggregation, "scannet/s_vh_clean_2.ply", 12),
    ("scannet/s_vh_clean_2.0.010000.segs.json", segments, "scannet/s_vh_clean_2.ply", 12)]

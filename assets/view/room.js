// The room's surfaces, cut open towards the viewer.

const roomVertexShader = `
  attribute vec3 tint;
  varying vec3 place;
  varying vec3 shade;
  void main() {
    vec4 world = modelMatrix * vec4(position, 1.0);
    place = world.xyz;
    shade = tint;
    gl_Position = projectionMatrix * viewMatrix * world;
  }`;

// Structure above the plane `cut`, or above the ceiling, is left away; the foot of walls stays.
const roomFragmentShader = `
  uniform vec4 cut;
  uniform float keep_below;
  uniform float ceiling;
  uniform float is_structure;
  varying vec3 place;
  varying vec3 shade;
  void main() {
    if (is_structure > 0.5 && (place.z > ceiling ||
        (dot(cut.xyz, place) > cut.w && place.z > keep_below))) discard;
    vec3 to_eye = normalize(cameraPosition - place);
    vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
    if (dot(normal, to_eye) < 0.0) normal = -normal;
    float light = 0.60 + 0.22 * normal.z + 0.06 * normal.x + 0.16 * abs(dot(normal, to_eye));
    gl_FragColor = vec4(shade * light, 1.0);
  }`;

/// The part of a wall that stays, as in the overview pictures of `dollytrack plan --picture`: a
/// plane falls from the top of the far walls to the foot of the near ones. `aside` is the viewer's
/// horizontal direction, at most of length 1.
function cutTowards(storey, aside) {
  const low = new THREE.Vector3(...storey.low);
  const high = new THREE.Vector3(...storey.high);
  const size = high.clone().sub(low);
  const height = Math.max(size.z, 0.5);
  const half_depth = 0.5 * (Math.abs(aside.x) * size.x + Math.abs(aside.y) * size.y);
  const slope = 0.95 * height / Math.max(0.75 * half_depth, 0.1);
  const normal = new THREE.Vector3(slope * aside.x, slope * aside.y, 1);
  const full_height = low.clone().add(high).multiplyScalar(0.5)
    .addScaledVector(aside, -0.3 * half_depth);
  full_height.z = high.z - 0.04;
  return new THREE.Vector4(normal.x, normal.y, normal.z, normal.dot(full_height));
}

/// Everything that has the room's surfaces: `group` for the scene, and questions of them.
class Room {
  constructor(data) {
    this.data = data;
    this.group = new THREE.Group();
    this.uniforms = {
      cut: {value: new THREE.Vector4(0, 0, 1, 1e9)}, keep_below: {value: 0}, ceiling: {value: 1e9},
    };
    this.places = new Uint16Array(readBytes("positions").buffer);
    this.corners = new Uint32Array(readBytes("corners").buffer);
    this.position = new THREE.BufferAttribute(this.places, 3);
    this.tint = new THREE.BufferAttribute(readBytes("colors"), 3, true);
    this.world = new THREE.Matrix4().makeScale(data.step_m, data.step_m, data.step_m)
      .setPosition(...data.origin);
    this.parts = data.parts.map(([id, first, count, structure]) =>
      ({id, first, count, structure: structure === 1, moving: String(id) in dataset.motions,
        shown: true}));
    this.still = [false, true].map(structure => this.#mesh([], structure));
    this.moving = this.parts.filter(part => part.moving).map(part =>
      ({part, mesh: this.#mesh([part], part.structure)}));
  }

  #mesh(parts, structure) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", this.position);
    geometry.setAttribute("tint", this.tint);
    const mesh = new THREE.Mesh(geometry, new THREE.ShaderMaterial({
      vertexShader: roomVertexShader, fragmentShader: roomFragmentShader,
      uniforms: {...this.uniforms, is_structure: {value: structure ? 1 : 0}},
      side: THREE.DoubleSide, extensions: {derivatives: true},
      // So that lines on surfaces are not lost in them.
      polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
    }));
    mesh.matrixAutoUpdate = false;
    mesh.frustumCulled = false;
    mesh.matrix.copy(this.world);
    this.#setParts(mesh, parts);
    this.group.add(mesh);
    return mesh;
  }

  #setParts(mesh, parts) {
    const index = new Uint32Array(parts.reduce((sum, part) => sum + part.count, 0));
    let at = 0;
    for (const part of parts) {
      index.set(this.corners.subarray(part.first, part.first + part.count), at);
      at += part.count;
    }
    mesh.geometry.setIndex(new THREE.BufferAttribute(index, 1));
    mesh.visible = index.length > 0;
  }

  get storey() {
    return this.data.storeys[state.storey];
  }

  /// Leaves away what stands over the storey.
  showStorey() {
    for (const part of this.parts) {
      const object = objectById.get(part.id);
      part.shown = !object || isBelow(object, this.storey);
    }
    const still = this.parts.filter(part => part.shown && !part.moving);
    this.#setParts(this.still[0], still.filter(part => !part.structure));
    this.#setParts(this.still[1], still.filter(part => part.structure));
    for (const one of this.moving) one.mesh.visible = one.part.shown;
    this.uniforms.ceiling.value = this.storey.ceiling;
    this.uniforms.keep_below.value = this.storey.floor + 0.12;
  }

  moveObjects() {
    for (const {part, mesh} of this.moving) {
      mesh.matrix.copy(motionOf(part.id)).multiply(this.world);
      mesh.matrixWorldNeedsUpdate = true;
    }
  }

  cutTowards(eye, centre) {
    const way = eye.clone().sub(centre);
    const length = Math.max(way.length(), 1e-6);
    const across = Math.hypot(way.x, way.y);
    // From straight above nothing has to be cut.
    const reach = Math.min(1, across / length / 0.66) / Math.max(across, 1e-6);
    this.uniforms.cut.value.copy(
      cutTowards(this.storey, new THREE.Vector3(way.x * reach, way.y * reach, 0)));
  }

  #isCut(point) {
    const {cut, keep_below, ceiling} = this.uniforms;
    const above = cut.value.x * point.x + cut.value.y * point.y + cut.value.z * point.z;
    return point.z > ceiling.value || (above > cut.value.w && point.z > keep_below.value);
  }

  /// The object whose surface a ray meets first, of what is not left away: {id, distance} or null.
  hit(ray) {
    let nearest = null;
    const [a, b, c, point] = [0, 1, 2, 3].map(() => new THREE.Vector3());
    const toWorld = new THREE.Matrix4();
    const load = (vector, corner) => vector.fromArray(this.places, 3 * this.corners[corner])
      .applyMatrix4(toWorld);
    for (const part of this.parts) {
      if (!part.shown) continue;
      toWorld.copy(this.world);
      if (part.moving) toWorld.premultiply(motionOf(part.id));
      for (let i = part.first; i < part.first + part.count; i += 3) {
        load(a, i), load(b, i + 1), load(c, i + 2);
        if (!ray.intersectTriangle(a, b, c, false, point)) continue;
        const distance = point.distanceTo(ray.origin);
        if (nearest && distance >= nearest.distance) continue;
        if (part.structure && this.#isCut(point)) continue;
        nearest = {id: part.id, distance};
      }
    }
    return nearest;
  }
}

/// Whether an object belongs to a storey or one below it.
function isBelow(object, storey) {
  return object.center[2] - 0.5 * object.size[2] < storey.hidden_from_z;
}

/// How an object has moved since rest, in the chosen frame.
function motionOf(id) {
  const motion = dataset.motions[id];
  const matrix = new THREE.Matrix4();
  if (!motion || frames.length === 0) return matrix;
  const [position, rotation] = motion[state.frame];
  return matrix.compose(new THREE.Vector3(...position), new THREE.Quaternion(...rotation),
    new THREE.Vector3(1, 1, 1));
}

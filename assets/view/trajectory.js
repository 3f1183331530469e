// The camera's path and where it stands in each frame.

/// From blue at the start to orange at the end, as in pictures of plans.
function timeColor(share) {
  const start = [0.10, 0.45, 0.92];
  const middle = [0.72, 0.22, 0.74];
  const end = [0.98, 0.45, 0.08];
  const [from, to, along] = share < 0.5 ? [start, middle, 2 * share] : [middle, end, 2 * share - 1];
  return from.map((value, i) => value + (to[i] - value) * along);
}

function timeShare(index) {
  return frames.length > 1 ? index / (frames.length - 1) : 0;
}

/// The corners of a frame's picture at a distance before the camera, and the camera: 5 points.
function frustumPoints(frame, length) {
  const {width, height, fx, fy, cx, cy} = dataset.lens;
  const rotation = new THREE.Quaternion(...frame.rotation);
  const eye = new THREE.Vector3(...frame.position);
  const at = (x, y) => new THREE.Vector3((x - cx) / fx, (y - cy) / fy, 1).multiplyScalar(length)
    .applyQuaternion(rotation).add(eye);
  return [at(0, 0), at(width, 0), at(width, height), at(0, height), eye];
}

const frustumEdges = [0, 1, 1, 2, 2, 3, 3, 0, 4, 0, 4, 1, 4, 2, 4, 3];

function lineGeometry(points, colors) {
  const geometry = new THREE.BufferGeometry().setFromPoints(points);
  geometry.setAttribute("color", new THREE.Float32BufferAttribute(colors, 3));
  return geometry;
}

/// A pipe with four sides along the frames that are shown: lines of WebGL are one pixel wide.
function pathGeometry(radius, isShown) {
  const positions = [], colors = [], index = [];
  for (const [i, frame] of frames.entries()) {
    const at = new THREE.Vector3(...frame.position);
    const next = frames[i + 1] && !frames[i + 1].begins ? frames[i + 1] : null;
    const before = frame.begins ? frame : frames[i - 1];
    const way = new THREE.Vector3(...(next || frame).position)
      .sub(new THREE.Vector3(...before.position));
    if (way.lengthSq() < 1e-12) way.set(1, 0, 0);
    way.normalize();
    const aside = new THREE.Vector3(0, 0, 1).cross(way);
    if (aside.lengthSq() < 1e-6) aside.set(1, 0, 0);
    aside.normalize();
    const above = way.clone().cross(aside);
    for (const [x, y] of [[1, 0], [0, 1], [-1, 0], [0, -1]]) {
      positions.push(...at.clone().addScaledVector(aside, radius * x)
        .addScaledVector(above, radius * y).toArray());
      colors.push(...timeColor(timeShare(i)));
    }
    if (!next || !isShown(frame) || !isShown(next)) continue;
    for (let side = 0; side < 4; ++side) {
      const a = 4 * i + side, b = 4 * i + (side + 1) % 4;
      index.push(a, b, a + 4, b, b + 4, a + 4);
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(positions, 3));
  geometry.setAttribute("color", new THREE.Float32BufferAttribute(colors, 3));
  geometry.setIndex(index);
  return geometry;
}

function cameraGeometry(length, isShown) {
  const points = [], colors = [];
  for (const frame of frames.filter(isShown)) {
    const corners = frustumPoints(frame, length);
    for (const corner of frustumEdges) {
      points.push(corners[corner]);
      colors.push(...timeColor(timeShare(frame.index)));
    }
  }
  return lineGeometry(points, colors);
}

class Trajectory {
  /// `size`: of the whole scene, m.
  constructor(size) {
    this.length = Math.min(Math.max(0.011 * size, 0.06), 0.22);
    this.radius = Math.min(Math.max(0.0011 * size, 0.004), 0.03);
    this.path = new THREE.Mesh(new THREE.BufferGeometry(), new THREE.MeshBasicMaterial(
      {vertexColors: THREE.VertexColors, side: THREE.DoubleSide}));
    this.cameras = new THREE.LineSegments(new THREE.BufferGeometry(),
      new THREE.LineBasicMaterial({vertexColors: THREE.VertexColors}));
    this.chosen = new THREE.Group();
    this.chosen_face = new THREE.Mesh(new THREE.BufferGeometry(), new THREE.MeshBasicMaterial(
      {side: THREE.DoubleSide, transparent: true, opacity: 0.5, depthTest: false}));
    this.chosen_lines = new THREE.LineSegments(new THREE.BufferGeometry(),
      new THREE.LineBasicMaterial({depthTest: false, transparent: true}));
    this.chosen.add(this.chosen_face, this.chosen_lines);
    this.hovered = new THREE.Group();
    this.hovered_face = new THREE.Mesh(new THREE.BufferGeometry(),
      this.chosen_face.material.clone());
    this.hovered_lines = new THREE.LineSegments(new THREE.BufferGeometry(),
      this.chosen_lines.material.clone());
    this.hovered.add(this.hovered_face, this.hovered_lines);
    this.hovered.visible = false;
    for (const one of [this.path, this.cameras, this.chosen_face, this.chosen_lines,
      this.hovered_face, this.hovered_lines]) {
      one.frustumCulled = false;
    }
    this.showFrame();
  }

  /// Frames for which `isShown(frame)` holds.
  show(isShown) {
    for (const one of [this.path, this.cameras]) one.geometry.dispose();
    this.path.geometry = pathGeometry(this.radius, isShown);
    this.cameras.geometry = cameraGeometry(this.length, isShown);
  }

  /// The chosen frame's camera is three times as large as the others.
  showFrame() {
    this.chosen.visible = frames.length > 0;
    if (frames.length > 0) this.#enlarge(state.frame, this.chosen_face, this.chosen_lines);
  }

  /// So is the camera under the pointer; null for none.
  showHovered(index) {
    this.hovered.visible = index !== null;
    if (index === null) return;
    this.#enlarge(index, this.hovered_face, this.hovered_lines);
    this.hovered_lines.material.color = pageColor("--accent");
  }

  #enlarge(index, face, lines) {
    const corners = frustumPoints(frames[index], 3 * this.length);
    lines.geometry.setFromPoints(frustumEdges.map(corner => corners[corner]));
    face.geometry.setFromPoints([0, 1, 2, 0, 2, 3].map(corner => corners[corner]));
    face.material.color = new THREE.Color(...timeColor(timeShare(index)));
  }
}

// Objects as boxes with labels.

const boxEdges = [0, 1, 2, 3, 4, 5, 6, 7, 0, 2, 1, 3, 4, 6, 5, 7, 0, 4, 1, 5, 2, 6, 3, 7];

/// From an object's box (of side 1 around its middle) to the world, in the chosen frame.
function boxMatrix(object) {
  const turn = new THREE.Quaternion().setFromAxisAngle(new THREE.Vector3(0, 0, 1), object.yaw_rad);
  const size = new THREE.Vector3(...object.size.map(side => Math.max(side, 1e-3)));
  return motionOf(object.id).multiply(
    new THREE.Matrix4().compose(new THREE.Vector3(...object.center), turn, size));
}

function boxCorners(object) {
  const matrix = boxMatrix(object);
  return [...Array(8).keys()].map(i =>
    new THREE.Vector3((i & 1) - 0.5, (i >> 1 & 1) - 0.5, (i >> 2 & 1) - 0.5).applyMatrix4(matrix));
}

function boxVolume(object) {
  return object.size[0] * object.size[1] * object.size[2];
}

function boxColor(object) {
  if (state.colors === "capture") return pageColor("--box-" + captureOf(object));
  const {hue, shift} = boxClassByName.get(object.class);
  return new THREE.Color(`hsl(${hue}, 70%, ${parseInt(pageValue("--class-lightness")) + shift}%)`);
}

/// The name as a label has it; lists show all of it.
function shortName(name) {
  return name.length > 32 ? name.slice(0, 31) + "…" : name;
}

class Boxes {
  constructor() {
    this.lines = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial(
      {vertexColors: THREE.VertexColors, transparent: true, opacity: 0.75}));
    const side = new THREE.BoxGeometry(1, 1, 1);
    this.chosen = new THREE.Group();
    this.chosen.add(
      new THREE.Mesh(side, new THREE.MeshBasicMaterial(
        {transparent: true, opacity: 0.3, depthWrite: false, side: THREE.DoubleSide})),
      new THREE.LineSegments(new THREE.EdgesGeometry(side),
        // Transparent, because the room's surfaces would be drawn over opaque lines without depth.
        new THREE.LineBasicMaterial({depthTest: false, transparent: true})));
    this.chosen.matrixAutoUpdate = false;
    this.hovered = this.chosen.clone();
    this.hovered.traverse(part => {
      if (part.material) part.material = part.material.clone();
    });
    this.hovered.visible = false;
    this.lines.frustumCulled = false;
    this.shown = [];
  }

  /// Targets of the storeys that are shown, as `isShown(object)` says, without hidden classes.
  show(isShown) {
    this.shown = objects.filter(object => object.role === "target" &&
      !state.hidden.has(object.class) && isShown(object));
    const points = [], colors = [];
    for (const object of this.shown) {
      const corners = boxCorners(object);
      const color = boxColor(object).toArray();
      for (const corner of boxEdges) {
        points.push(corners[corner]);
        colors.push(...color);
      }
    }
    this.lines.geometry.dispose();
    this.lines.geometry = lineGeometry(points, colors);
  }

  showChosen() {
    const object = objectById.get(state.object);
    this.chosen.visible = object !== undefined;
    if (!object) return;
    this.chosen.matrix.copy(boxMatrix(object));
    this.chosen.matrixWorldNeedsUpdate = true;
    for (const part of this.chosen.children) part.material.color = pageColor("--accent");
  }

  /// Highlights the object under the pointer; null for none.
  showHovered(id) {
    const object = objectById.get(id);
    this.hovered.visible = object !== undefined;
    if (!object) return;
    this.hovered.matrix.copy(boxMatrix(object));
    this.hovered.matrixWorldNeedsUpdate = true;
    for (const part of this.hovered.children) part.material.color = pageColor("--accent");
  }

  /// The nearest and, of boxes within each other, the smallest box that a ray meets: an id or null.
  hit(ray) {
    let best = null;
    const point = new THREE.Vector3();
    const unit = new THREE.Box3(new THREE.Vector3(-0.5, -0.5, -0.5),
      new THREE.Vector3(0.5, 0.5, 0.5));
    for (const object of this.shown) {
      const matrix = boxMatrix(object);
      const within = ray.clone().applyMatrix4(new THREE.Matrix4().getInverse(matrix));
      if (!within.intersectBox(unit, point)) continue;
      const volume = boxVolume(object);
      if (!best || volume < best.volume) best = {id: object.id, volume};
    }
    return best ? best.id : null;
  }
}

/// Names beside objects as far as they do not cover each other: the chosen one first, then what is
/// not captured, then the largest.
class Labels {
  constructor(place) {
    this.place = place;
    this.spans = [];
    this.taken = [];
    this.ranks = new Map(objects.map(object =>
      [object.id, (captureOf(object) === "missed" ? 1e6 : 0) + boxVolume(object)]));
  }

  /// At most `most` labels of objects, and one of the chosen camera ({text, point} or null).
  /// `toScreen(point)`: {x, y} in pixels, or null where it is not in view.
  show(candidates, camera, toScreen, most) {
    this.used = 0;
    this.taken = [];
    if (camera) this.#put(camera.text, "camera", toScreen(camera.point), null);
    const ranked = candidates.slice().sort((a, b) => this.#rank(b) - this.#rank(a));
    for (const object of ranked) {
      if (this.used >= most) break;
      const top = new THREE.Vector3(0, 0, 0.5).applyMatrix4(boxMatrix(object));
      this.#put(shortName(object.name), object.id === state.object ? "chosen" : "", toScreen(top),
        object.id);
    }
    for (const span of this.spans.slice(this.used)) span.hidden = true;
  }

  /// The object whose label covers a position in the view, in pixels; null for none.
  hit(x, y) {
    const found = this.taken.find(box =>
      x >= box.left && x <= box.right && y >= box.top && y <= box.bottom);
    return found ? found.id : null;
  }

  /// Does nothing if another label is in the way.
  #put(text, kind, at, id) {
    if (!at) return;
    const half = 3.3 * text.length + 6;
    const box = {left: at.x - half, top: at.y - 22, right: at.x + half, bottom: at.y - 3, id};
    const covers = this.taken.some(other => box.left < other.right && box.right > other.left &&
      box.top < other.bottom && box.bottom > other.top);
    if (covers || box.left < 2 || box.top < 2 || box.right > this.place.clientWidth - 2) return;
    this.taken.push(box);
    const span = this.#span(this.used++);
    span.textContent = text;
    span.className = kind;
    span.style.transform =
      `translate(${Math.round(at.x)}px, ${Math.round(at.y - 20)}px) translateX(-50%)`;
    span.hidden = false;
  }

  #rank(object) {
    return object.id === state.object ? Infinity : this.ranks.get(object.id);
  }

  #span(i) {
    if (!this.spans[i]) {
      this.spans[i] = make("span");
      this.place.append(this.spans[i]);
    }
    return this.spans[i];
  }
}

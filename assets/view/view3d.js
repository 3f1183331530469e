// The 3D view: what it shows, from where, and when it is drawn anew.

/// A value of the page's style.
function pageValue(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

/// A colour of the page's style.
function pageColor(name) {
  return new THREE.Color(pageValue(name) || "#808080");
}

/// All that has to be in view at first: of the chosen storey, else of what there is.
function wholeBox() {
  const box = new THREE.Box3();
  if (roomData) {
    const storey = roomData.storeys[state.storey];
    box.set(new THREE.Vector3(...storey.low), new THREE.Vector3(...storey.high));
  } else {
    for (const object of objects) for (const corner of boxCorners(object)) box.expandByPoint(corner);
    for (const frame of frames) box.expandByPoint(new THREE.Vector3(...frame.position));
  }
  if (box.isEmpty()) box.set(new THREE.Vector3(-1, -1, -1), new THREE.Vector3(1, 1, 1));
  return box;
}

class View3d {
  /// Throws where there is no WebGL.
  constructor(place, labels_place) {
    this.place = place;
    this.renderer = new THREE.WebGLRenderer({antialias: true});
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
    this.renderer.gammaOutput = false;
    this.canvas = this.renderer.domElement;
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("aria-label", "The scene: drag to turn, wheel to come nearer, " +
      "right button to shift, click a camera or an object");
    place.append(this.canvas);
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(30, 1, 0.05, 1000);
    this.camera.up.set(0, 0, 1);
    this.controls = new THREE.OrbitControls(this.camera, this.canvas);
    this.controls.enableKeys = false;
    this.controls.screenSpacePanning = true;
    this.controls.maxPolarAngle = 0.97 * Math.PI;
    this.room = roomData ? new Room(roomData) : null;
    const whole = wholeBox();
    this.centre = whole.getCenter(new THREE.Vector3());
    this.size = whole.getSize(new THREE.Vector3()).length();
    this.trajectory = new Trajectory(this.size);
    this.boxes = new Boxes();
    this.labels = new Labels(labels_place);
    this.layers = {
      room: this.room ? this.room.group : null, path: this.trajectory.path,
      cameras: this.trajectory.cameras, boxes: this.boxes.lines, labels: {visible: true},
    };
    for (const layer of [this.layers.room, this.trajectory.path, this.trajectory.cameras,
      this.trajectory.chosen, this.trajectory.hovered, this.boxes.lines, this.boxes.chosen,
      this.boxes.hovered]) {
      if (layer) this.scene.add(layer);
    }
    this.#follow();
  }

  #follow() {
    this.controls.addEventListener("change", () => this.draw());
    this.controls.addEventListener("end", () => this.#keepView());
    new ResizeObserver(() => this.#resize()).observe(this.place);
    matchMedia("(prefers-color-scheme: dark)").addListener(() => this.#showAll());
    watch(changed => {
      if (changed.has("storey")) {
        this.#showAll();
        if (!changed.has("view")) this.reset();
      }
      if (changed.has("view")) this.#takeView();
      if (changed.has("frame")) {
        this.trajectory.showFrame();
        if (this.room) this.room.moveObjects();
        if (Object.keys(dataset.motions).length > 0) this.#showBoxes();
      }
      if (changed.has("colors") || changed.has("hidden")) this.#showBoxes();
      this.boxes.showChosen();
      this.draw();
    });
    this.#resize();
    this.#showAll();
    this.reset();
  }

  #resize() {
    const {clientWidth: width, clientHeight: height} = this.place;
    if (width < 1 || height < 1) return;
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (state.view === null) this.reset();
    this.drawNow();
  }

  isShown(object) {
    return !this.room || isBelow(object, this.room.storey);
  }

  isFrameShown(frame) {
    return !this.room || frame.position[2] < this.room.storey.hidden_from_z;
  }

  #showBoxes() {
    this.boxes.show(object => this.isShown(object));
  }

  #showAll() {
    this.renderer.setClearColor(pageColor("--view"));
    if (this.room) {
      this.room.showStorey();
      this.room.moveObjects();
    }
    this.trajectory.show(frame => this.isFrameShown(frame));
    this.#showBoxes();
    this.boxes.showChosen();
    this.trajectory.chosen_lines.material.color = pageColor("--accent");
    this.draw();
  }

  /// Highlights what is under the pointer: {frame}, {object}, or null.
  highlight(picked) {
    const {frame = null, object = null} = picked || {};
    if (this.highlighted && this.highlighted.frame === frame &&
      this.highlighted.object === object) return;
    this.highlighted = {frame, object};
    this.trajectory.showHovered(frame);
    this.boxes.showHovered(object);
    this.canvas.classList.toggle("clickable", picked !== null);
    this.draw();
  }

  /// Looks at the whole storey from above at an angle.
  reset() {
    const box = wholeBox();
    const centre = box.getCenter(new THREE.Vector3());
    const azimuth = 248 * Math.PI / 180, elevation = 52 * Math.PI / 180;
    const way = new THREE.Vector3(Math.cos(azimuth) * Math.cos(elevation),
      Math.sin(azimuth) * Math.cos(elevation), Math.sin(elevation));
    // The floor's corners, and the tops of the walls that are not cut.
    const corners = [0, 1, 2, 3, 4, 5, 6, 7].map(i => new THREE.Vector3(
      i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z))
      .filter(corner => !this.room || corner.z < centre.z ||
        corner.clone().sub(centre).setZ(0).dot(way) < 0);
    const fits = distance => {
      this.camera.position.copy(centre).addScaledVector(way, distance);
      this.camera.lookAt(centre);
      this.#setDepthRange();
      this.camera.updateMatrixWorld();
      return corners.every(corner => {
        const at = corner.clone().project(this.camera);
        return Math.abs(at.x) < 0.94 && at.y < 0.84 && at.y > -0.9 && at.z < 1;
      });
    };
    const size = this.size;
    let [near, far] = [0.3 * size, 12 * size];
    for (let i = 0; i < 30; ++i) {
      const middle = 0.5 * (near + far);
      if (fits(middle)) far = middle; else near = middle;
    }
    fits(far);
    this.controls.target.copy(centre);
    this.controls.update();
    choose({view: null});
    this.draw();
  }

  #keepView() {
    const numbers = [...this.camera.position.toArray(), ...this.controls.target.toArray()];
    choose({view: numbers.map(number => number.toFixed(3)).join(",")});
  }

  #takeView() {
    if (state.view === null) return;
    const numbers = state.view.split(",").map(Number);
    const eye = new THREE.Vector3(...numbers.slice(0, 3));
    if (eye.distanceTo(this.camera.position) < 0.02) return;  // it comes from here
    this.camera.position.copy(eye);
    this.controls.target.set(...numbers.slice(3));
    this.controls.update();
  }

  /// A place in the view of a point in the world, px from the top left; null outside of it.
  toScreen(point) {
    const at = point.clone().project(this.camera);
    if (at.z > 1 || Math.abs(at.x) > 1 || Math.abs(at.y) > 1) return null;
    return {x: (0.5 + 0.5 * at.x) * this.place.clientWidth,
      y: (0.5 - 0.5 * at.y) * this.place.clientHeight};
  }

  draw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => this.drawNow());
  }

  /// As narrow as the scene allows: surfaces close to each other then stay apart.
  #setDepthRange() {
    const distance = this.camera.position.distanceTo(this.centre);
    this.camera.near = Math.max(0.004 * this.size, distance - 1.2 * this.size);
    this.camera.far = distance + 3 * this.size;
    this.camera.updateProjectionMatrix();
  }

  drawNow() {
    this.waiting = false;
    this.#setDepthRange();
    if (this.room) this.room.cutTowards(this.camera.position, this.controls.target);
    this.renderer.render(this.scene, this.camera);
    const chosen = objectById.get(state.object);
    const candidates = this.layers.labels.visible ? this.boxes.shown.slice() : [];
    if (chosen && !candidates.includes(chosen)) candidates.push(chosen);
    const area = this.place.clientWidth * this.place.clientHeight;
    const camera = this.trajectory.chosen.visible ? {
      text: `Frame ${state.frame}`, point: new THREE.Vector3(...frames[state.frame].position),
    } : null;
    this.labels.show(candidates, camera, point => this.toScreen(point),
      Math.min(40, area / 24000));
  }
}

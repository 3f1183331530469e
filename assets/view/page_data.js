"use strict";
// What the page carries, as dollytrack wrote it into the script elements before this one.

const readJson = id => JSON.parse(document.getElementById("data-" + id).textContent);

const dataset = readJson("dataset");
const roomData = readJson("room");  // null without the scene
const pictureKinds = readJson("pictures");

const frames = dataset.frames.map(([time_s, position, rotation, begins], index) =>
  ({index, time_s, position, rotation, begins: begins === 1}));
const objects = dataset.objects;
const objectById = new Map(objects.map(object => [object.id, object]));

/// The frames that are the best view of some captured object: a list of objects by frame. An object
/// that is not captured also has a frame that shows the most of it, but too little to be of use.
const bestOfFrame = new Map();
for (const object of objects) {
  if (!hasBestView(object)) continue;
  if (!bestOfFrame.has(object.best_frame)) bestOfFrame.set(object.best_frame, []);
  bestOfFrame.get(object.best_frame).push(object);
}

/// Whether the object is captured in a frame, so that a user can be led to it.
function hasBestView(object) {
  return object.captured === true && object.best_frame >= 0;
}

/// The classes of the objects that have boxes, the most frequent first.
const boxClasses = classesOf(objects.filter(object => object.role === "target"));
const boxClassByName = new Map(boxClasses.map(one => [one.name, one]));

/// {name, count, captured, hue, shift}. Neighbours in the list differ most in hue; after each eight
/// the lightness shifts, in percent, because eight hues are what can be told apart.
function classesOf(targets) {
  const found = new Map();
  for (const object of targets) {
    if (!found.has(object.class)) {
      found.set(object.class, {name: object.class, count: 0, captured: 0});
    }
    const one = found.get(object.class);
    ++one.count;
    if (object.captured) ++one.captured;
  }
  const sorted = [...found.values()].sort((a, b) =>
    b.count - a.count || (a.name < b.name ? -1 : 1));
  const golden_angle_deg = 137.508;
  return sorted.map((one, i) => ({...one, hue: Math.round(215 + golden_angle_deg * i) % 360,
    shift: [0, 12, -10][Math.floor(i / 8) % 3]}));
}

/// A class's colour for style sheets; it follows the page's light or dark look.
function classStyle(name) {
  const {hue, shift} = boxClassByName.get(name);
  return `hsl(${hue}, 70%, calc(var(--class-lightness) + ${shift}%))`;
}

/// The bytes of an element's base64 text.
function readBytes(id) {
  const text = atob(document.getElementById("data-" + id).textContent);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

/// "well", "captured", "missed", or "none" for what is no target.
function captureOf(object) {
  if (object.well_captured) return "well";
  if (object.captured) return "captured";
  return object.role === "target" ? "missed" : "none";
}

const captureWords = {
  well: "well captured", captured: "captured", missed: "not captured", none: "no target",
};

/// A document element with properties and children; text children are never markup.
function make(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

function showHeader() {
  const targets = objects.filter(object => object.role === "target");
  const captured = targets.filter(object => object.captured).length;
  const well = targets.filter(object => object.well_captured).length;
  document.title = `${dataset.name} – dataset`;
  document.getElementById("title").textContent = dataset.name;
  const words = [`${frames.length} frames`,
    `${targets.length} objects, ${captured} captured, ${well} well captured`];
  if (dataset.scene) words.unshift(`of ${dataset.scene}`);
  if (dataset.cameras.length > 0) {
    words.push(`shown: the planned camera, not ${dataset.cameras.join(", ")} of the rig`);
  }
  document.getElementById("summary").textContent = words.join(" · ");
  const notes = document.getElementById("notes");
  notes.append(...readJson("notes").map(note => make("li", {textContent: note})));
  notes.hidden = notes.children.length === 0;
}
showHeader();

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

/// The frames that are the best view of some object: a list of objects by frame.
const bestOfFrame = new Map();
for (const object of objects) {
  if (!(object.best_frame >= 0)) continue;
  if (!bestOfFrame.has(object.best_frame)) bestOfFrame.set(object.best_frame, []);
  bestOfFrame.get(object.best_frame).push(object);
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

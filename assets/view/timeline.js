// The timeline, playing, and keys.

const shortestStep_ms = 40, longestStep_ms = 500;

class Timeline {
  constructor() {
    this.slider = document.getElementById("slider");
    this.button = document.getElementById("play");
    this.slider.max = Math.max(frames.length - 1, 0);
    this.slider.disabled = this.button.disabled = frames.length < 2;
    this.timer = 0;
    this.slider.addEventListener("input", () => choose({frame: Number(this.slider.value)}));
    this.button.addEventListener("click", () => this.toggle());
    watch(changed => { if (changed.has("frame")) this.#show(); });
    this.#show();
  }

  #show() {
    this.slider.value = state.frame;
    document.getElementById("now").textContent = frames.length === 0 ? "no frames"
      : `Frame ${state.frame} of 0–${frames.length - 1} · ${frames[state.frame].time_s.toFixed(2)} s`;
  }

  step(count) {
    choose({frame: Math.min(Math.max(state.frame + count, 0), frames.length - 1)});
  }

  get playing() {
    return this.timer !== 0;
  }

  toggle() {
    if (this.button.disabled) return;
    if (this.playing) {
      this.stop();
      return;
    }
    if (state.frame === frames.length - 1) choose({frame: 0});
    this.button.textContent = "Pause";
    this.#playOn();
  }

  stop() {
    clearTimeout(this.timer);
    this.timer = 0;
    this.button.textContent = "Play";
  }

  /// As fast as the camera moved, within limits.
  #playOn() {
    if (state.frame >= frames.length - 1) {
      this.stop();
      return;
    }
    const step = 1000 * (frames[state.frame + 1].time_s - frames[state.frame].time_s);
    this.timer = setTimeout(() => {
      this.step(1);
      this.#playOn();
    }, Math.min(Math.max(step, shortestStep_ms), longestStep_ms));
  }
}

/// The list of keys, over the page.
class Help {
  constructor() {
    this.dialog = document.getElementById("help");
    document.getElementById("show-help").addEventListener("click", () => this.toggle());
    document.getElementById("close-help").addEventListener("click", () => this.toggle());
    // What is beside the list belongs to the dialog itself.
    this.dialog.addEventListener("click", event => {
      if (event.target === this.dialog) this.toggle();
    });
  }

  get open() {
    return this.dialog.open;
  }

  toggle() {
    if (this.open) this.dialog.close(); else this.dialog.showModal();
  }
}

function startKeys(timeline, help) {
  const search = document.getElementById("search");
  const actions = {
    ArrowLeft: event => timeline.step(event.shiftKey ? -10 : -1),
    ArrowRight: event => timeline.step(event.shiftKey ? 10 : 1),
    Home: () => choose({frame: 0}),
    End: () => choose({frame: frames.length - 1}),
    " ": () => timeline.toggle(),
    "/": () => {
      showList("object-list");
      search.focus();
    },
    "?": () => help.toggle(),
    Escape: () => choose({object: null}),
  };
  let reached_by_keys = false;
  document.addEventListener("pointerdown", () => { reached_by_keys = false; }, true);
  document.addEventListener("keydown", event => {
    if (event.key === "Tab") reached_by_keys = true;
    if (help.open) {
      if (event.key !== "Escape" && event.key !== "?") return;
      event.preventDefault();
      help.toggle();
      return;
    }
    const typing = event.target === search || event.target instanceof HTMLSelectElement;
    if (event.key === "Escape" && event.target === search) search.blur();
    if ((typing && event.key !== "Escape") || event.ctrlKey || event.altKey || event.metaKey) return;
    // What was reached by keys is pressed by the space bar. (:focus-visible would not do: after a
    // click it matches as soon as any key is pressed.)
    if (event.key === " " && reached_by_keys && event.target.matches("button, [type=checkbox]")) {
      return;
    }
    const action = actions[event.key];
    if (!action) return;
    event.preventDefault();
    action(event);
  });
}
startKeys(new Timeline(), new Help());
readAddress();
window.addEventListener("hashchange", readAddress);

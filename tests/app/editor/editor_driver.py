"""Uses the editor as a person does: a real window on a separate display, real mouse and key events.

The state of the window is read through the socket of --inspect, which cannot change it.
"""
import contextlib
import json
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import tempfile
import time

try:
    from Xlib import X, XK, display, error
    from Xlib.ext import xtest
except ImportError:  # the tests are then skipped, or fail where a window is required
    pass

import other_programs
from screen import die_with_parent

BUTTONS = {"left": 1, "middle": 2, "right": 3}
# Names of keys as written in the menus, where X's names differ.
KEYSYMS = {"ctrl": "Control_L", "shift": "Shift_L", "alt": "Alt_L", "enter": "Return",
           "esc": "Escape", "del": "Delete", "space": "space", "home": "Home", "end": "End",
           "left": "Left", "right": "Right", "up": "Up", "down": "Down", "tab": "Tab",
           "backspace": "BackSpace", "=": "equal", "-": "minus", "numplus": "KP_Add",
           "numminus": "KP_Subtract", "num.": "KP_Decimal", "num/": "KP_Divide",
           "pageup": "Prior", "pagedown": "Next"}


class Gone(Exception):
    """The editor ended or no longer answers."""


class Editor:
    """One running editor with its window, mouse and keyboard."""

    def __init__(self, program, screen, *arguments, home, size=(1280, 720), options=()):
        self.home = pathlib.Path(home)
        self.home.mkdir(parents=True, exist_ok=True)
        # A Unix socket's name has to be short, and a test's folder may not be.
        self.socket_folder = tempfile.mkdtemp(prefix="ed")
        path = os.path.join(self.socket_folder, "s")
        environment = {key: value for key, value in os.environ.items()
                       if key not in ("XDG_CURRENT_DESKTOP", "WAYLAND_DISPLAY")}
        environment.update(DISPLAY=screen.name, HOME=str(self.home), LC_ALL="C",
                           XDG_CONFIG_HOME=str(self.home / "config"),
                           XDG_STATE_HOME=str(self.home / "state"))
        self.output = open(self.home / "output.txt", "ab")
        self.process = subprocess.Popen(
            [program, "--size", f"{size[0]}x{size[1]}", "--inspect", path, *options,
             *map(str, arguments)],
            env=environment, stdout=self.output, stderr=self.output, cwd=self.home,
            preexec_fn=die_with_parent)
        self.screen = screen
        self.connection = None
        try:
            self._connect(path)
            self.display = display.Display(screen.name)
            self.window = self._find_window()
            self._focus()
        except BaseException:
            self.kill()
            raise
        self.mouse = (0, 0)

    # Reading the state

    def _connect(self, path, seconds=60):
        deadline = time.time() + seconds
        while True:
            self.connection = socket.socket(socket.AF_UNIX)
            try:
                self.connection.connect(path)
                break
            except OSError:  # it is still starting
                self.connection.close()
            if self.process.poll() is not None or time.time() > deadline:
                raise Gone(self.last_words())
            time.sleep(0.02)
        self.connection.settimeout(60)
        self.lines = self.connection.makefile("rw")

    def last_words(self):
        self.output.flush()
        text = (self.home / "output.txt").read_text(errors="replace")[-2000:]
        return f"the editor ended with {self.process.poll()}: {text}"

    def alive(self):
        return self.process.poll() is None

    def state(self):
        """Everything that is shown, after two frames have handled the earlier events."""
        try:
            self.lines.write("state\n")
            self.lines.flush()
            line = self.lines.readline()
        except OSError as problem:
            raise Gone(f"{problem}; {self.last_words()}") from problem
        if not line:
            with contextlib.suppress(subprocess.TimeoutExpired):
                self.process.wait(5)
            raise Gone(self.last_words())
        return json.loads(line)

    def wait(self, condition, what, seconds=60):
        deadline = time.time() + seconds
        while True:
            state = self.state()
            if condition(state):
                return state
            if time.time() > deadline:
                shown = {key: value for key, value in state.items()
                         if key not in ("items", "parameters")}
                raise AssertionError(f"waited for {what} in vain: {json.dumps(shown)}")
            time.sleep(0.03)

    def idle(self, seconds=120):
        """Waits until nothing is computed and the newest plan is shown."""
        def at_rest(state):
            busy = state["busy"]
            working = busy["loading"] or busy["planning"] or busy["saving"]
            return not working and (not state["open"] or state["plan_is_current"] or
                                    state["plan_error"])
        return self.wait(at_rest, "the editor to come to rest", seconds)

    def items(self):
        return self.state()["items"]

    def has(self, name):
        return name in self.items()

    def item(self, name, seconds=10):
        """The rectangle of a widget; waits until it appears."""
        return self.wait(lambda state: name in state["items"], f"the item {name}",
                         seconds)["items"][name]

    def middle(self, name):
        left, top, right, bottom = self.item(name)[:4]
        return round((left + right) / 2), round((top + bottom) / 2)

    def picture(self):
        """The window as RGB bytes: (width, height, bytes)."""
        size = self.window.get_geometry()
        image = self.window.get_image(0, 0, size.width, size.height, X.ZPixmap, 0xFFFFFFFF)
        data = image.data
        rgb = bytearray(size.width * size.height * 3)
        rgb[0::3], rgb[1::3], rgb[2::3] = data[2::4], data[1::4], data[0::4]
        return size.width, size.height, bytes(rgb)

    # The mouse

    def move(self, x, y):
        self.mouse = (round(x), round(y))
        xtest.fake_input(self.display, X.MotionNotify, x=self.mouse[0], y=self.mouse[1])
        self.display.sync()

    def press(self, button="left"):
        xtest.fake_input(self.display, X.ButtonPress, BUTTONS.get(button, button))
        self.display.sync()

    def release(self, button="left"):
        xtest.fake_input(self.display, X.ButtonRelease, BUTTONS.get(button, button))
        self.display.sync()

    def point(self, target):
        """Moves the mouse to a widget or a position, and lets the window notice it."""
        x, y = self.middle(target) if isinstance(target, str) else target
        self.move(x, y)
        self.state()

    def click(self, target, button="left", keys=(), times=1):
        self.point(target)
        with self.held(*keys):
            for _ in range(times):
                self.press(button)
                if times == 1:
                    self.state()
                self.release(button)
        return self.state()

    def click_at_once(self, x, y):
        """Moves the mouse and clicks, faster than the window can draw a frame."""
        self.mouse = (round(x), round(y))
        xtest.fake_input(self.display, X.MotionNotify, x=self.mouse[0], y=self.mouse[1])
        xtest.fake_input(self.display, X.ButtonPress, BUTTONS["left"])
        xtest.fake_input(self.display, X.ButtonRelease, BUTTONS["left"])
        self.display.sync()

    def drag(self, start, end, button="left", keys=(), steps=8, look=None):
        """Drags from one position to another; `look` is called with each state on the way."""
        self.point(start)
        x0, y0 = self.mouse
        x1, y1 = self.middle(end) if isinstance(end, str) else end
        with self.held(*keys):
            self.press(button)
            self.state()
            for step in range(1, steps + 1):
                self.move(x0 + (x1 - x0) * step / steps, y0 + (y1 - y0) * step / steps)
                state = self.state()
                if look is not None:
                    look(state)
            self.release(button)
        return self.state()

    def wheel(self, target, notches):
        """Turns the mouse wheel, up with positive numbers."""
        self.point(target)
        for _ in range(abs(notches)):
            button = 4 if notches > 0 else 5
            self.press(button)
            self.release(button)
            self.state()

    def reach(self, name, over, most=60):
        """Scrolls a panel down until one of its widgets is fully visible."""
        for _ in range(most):
            items = self.items()
            if name in items and items[name][3] - items[name][1] > 10:
                return items[name]
            self.wheel(over, -2)
        raise AssertionError(f"{name} is nowhere in the panel")

    # The keyboard

    def _code(self, keysym):
        code = self.display.keysym_to_keycode(keysym)
        if code == 0:
            raise KeyError(f"this keyboard has no key {XK.keysym_to_string(keysym)}")
        return code

    def _keysym(self, name):
        keysym = XK.string_to_keysym(KEYSYMS.get(name.lower(), name))
        return keysym if keysym != 0 else ord(name)

    def hold(self, name):
        xtest.fake_input(self.display, X.KeyPress, self._code(self._keysym(name)))
        self.display.sync()

    def let_go(self, name):
        xtest.fake_input(self.display, X.KeyRelease, self._code(self._keysym(name)))
        self.display.sync()

    @contextlib.contextmanager
    def held(self, *names):
        for name in names:
            self.hold(name)
        if names:
            self.state()
        try:
            yield
        finally:
            for name in reversed(names):
                self.let_go(name)

    def key(self, chord):
        """'ctrl+shift+s', 'esc', 'F1'."""
        self.tap(chord)
        return self.state()

    def tap(self, chord):
        """Presses a key that may end the editor, so the state is not read afterwards."""
        *modifiers, last = chord.split("+")
        for name in (*modifiers, last):
            self.hold(name)
            time.sleep(0.03)
        for name in (last, *reversed(modifiers)):
            self.let_go(name)

    def letters(self, text):
        """Types text without reading the state afterwards."""
        for letter in text:
            keysym = ord(letter)
            code = self._code(keysym)
            shifted = self.display.keycode_to_keysym(code, 0) != keysym
            if shifted:
                self.hold("shift")
            xtest.fake_input(self.display, X.KeyPress, code)
            xtest.fake_input(self.display, X.KeyRelease, code)
            if shifted:
                self.let_go("shift")
            self.display.sync()
            time.sleep(0.004)  # one letter after the other, as people type

    def type(self, text):
        self.letters(text)
        return self.state()

    @contextlib.contextmanager
    def stuck(self):
        """Makes one frame last long, as on a busy machine: events in the meantime arrive all at
        once."""
        self.process.send_signal(signal.SIGSTOP)
        try:
            yield
        finally:
            self.process.send_signal(signal.SIGCONT)

    # What a window manager and other programs do

    def _find_window(self):
        """The editor's visible window; its other one belongs to the render thread."""
        deadline = time.time() + 30
        root = self.display.screen().root
        while time.time() < deadline:
            for window in root.query_tree().children:
                with contextlib.suppress(error.BadWindow):
                    shown = window.get_attributes().map_state == X.IsViewable
                    if shown and window.get_wm_class():
                        return window
            time.sleep(0.05)
        raise Gone("the editor opened no window: " + self.last_words())

    def _focus(self):
        self.window.set_input_focus(X.RevertToPointerRoot, X.CurrentTime)
        self.display.sync()

    def resize(self, width, height):
        self.window.configure(x=0, y=0, width=width, height=height)
        self.display.sync()
        self.state()
        return self.state()

    def close_window(self):
        """Clicks the close button of the window."""
        other_programs.close_window(self.display, self.window)

    def drop(self, *paths):
        """Drops files onto the middle of the window."""
        other_programs.drop(self.display, self.window, paths)
        return self.state()

    def clipboard(self):
        """The text that another program would paste."""
        # The owner of the clipboard answers when it handles its events.
        return other_programs.clipboard(self.display, self.state)

    # Common actions

    def menu(self, name, command):
        """Opens a menu and chooses an entry: menu('file', 'file.close')."""
        self.click("menu." + name)
        return self.click("command." + command)

    def run_command(self, words):
        """Runs a command with the command palette."""
        self.key("ctrl+p")
        self.item("palette.text")
        self.type(words)
        return self.key("enter")

    def choose_file(self, path):
        """Types a path into the open file dialog and accepts it."""
        self.item("files.path")
        self.click("files.path", times=2)
        self.key("ctrl+a")
        self.type(str(path))
        self.key("enter")
        self.wait(lambda state: not state["dialogs"]["file"] or "message.replace" in state["items"]
                  or "files.overwrite" in state["items"], "the file dialog to close", 10)

    def type_value(self, name, text):
        """Ctrl+clicks a number and types another one."""
        self.click(name, keys=["ctrl"])
        self.key("ctrl+a")
        self.type(text)
        return self.key("enter")

    # The end

    def wait_end(self, seconds=30):
        """Waits until the editor has ended by itself; returns its exit code."""
        try:
            return self.process.wait(seconds)
        except subprocess.TimeoutExpired as late:
            raise AssertionError("the editor does not end") from late

    def memory_mb(self):
        with open(f"/proc/{self.process.pid}/status") as status:
            for line in status:
                if line.startswith("VmRSS:"):
                    return int(line.split()[1]) / 1024
        return 0.0

    def kill(self):
        """Kills the editor, as a crash or a power cut would."""
        if self.alive():
            self.process.send_signal(signal.SIGKILL)
        self.process.wait()
        self.tidy()

    def tidy(self):
        with contextlib.suppress(Exception):
            self.display.close()
        with contextlib.suppress(Exception):
            self.lines.close()
        with contextlib.suppress(Exception):
            self.connection.close()
        self.output.close()
        shutil.rmtree(self.socket_folder, ignore_errors=True)

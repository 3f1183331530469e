"""Actions of a window manager and of other programs on a window, by X's protocols."""
import pathlib
import time

try:
    from Xlib import X
    from Xlib.protocol import event
except ImportError:  # need_window() says so
    pass


def tell(screen, window, kind, data):
    message = event.ClientMessage(window=window, client_type=screen.intern_atom(kind),
                                  data=(32, data))
    window.send_event(message)
    screen.sync()


def close_window(screen, window):
    """Asks the window to close, as its close button does."""
    protocols = screen.intern_atom("WM_DELETE_WINDOW")
    tell(screen, window, "WM_PROTOCOLS", [protocols, X.CurrentTime, 0, 0, 0])


def drop(screen, window, paths):
    """Drops files onto the middle of the window with the XDND protocol."""
    atom = screen.intern_atom
    source = screen.screen().root.create_window(0, 0, 1, 1, 0, X.CopyFromParent)
    try:
        source.set_selection_owner(atom("XdndSelection"), X.CurrentTime)
        uris, plain = atom("text/uri-list"), X.NONE
        version = 5 << 24
        size = window.get_geometry()
        x, y = size.width // 2, size.height // 2
        tell(screen, window, "XdndEnter", [source.id, version, uris, plain, plain])
        tell(screen, window, "XdndPosition",
             [source.id, 0, x << 16 | y, X.CurrentTime, atom("XdndActionCopy")])
        await_message(screen, "XdndStatus", lambda data: data[1] & 1)
        tell(screen, window, "XdndDrop", [source.id, 0, X.CurrentTime, 0, 0])
        text = "".join(pathlib.Path(path).absolute().as_uri() + "\r\n" for path in paths)
        serve_selection(screen, uris, text.encode())
    finally:
        source.destroy()
        screen.sync()


def events(screen, seconds):
    deadline = time.time() + seconds
    while time.time() < deadline:
        if screen.pending_events():
            yield screen.next_event()
        else:
            time.sleep(0.005)


def await_message(screen, kind, accepted):
    atom = screen.intern_atom(kind)
    for one in events(screen, 10):
        if one.type == X.ClientMessage and one.client_type == atom:
            if accepted(one.data[1]):
                return
            raise AssertionError("the editor refuses what is dragged over it")
    raise AssertionError(f"the editor sent no {kind}")


def serve_selection(screen, kind, content):
    finished = screen.intern_atom("XdndFinished")
    for one in events(screen, 10):
        if one.type == X.SelectionRequest:
            one.requestor.change_property(one.property, kind, 8, content)
            one.requestor.send_event(event.SelectionNotify(
                time=one.time, requestor=one.requestor, selection=one.selection,
                target=one.target, property=one.property))
            screen.sync()
        elif one.type == X.ClientMessage and one.client_type == finished:
            return
    raise AssertionError("the editor did not take what was dropped")


def clipboard(screen, let_owner_answer):
    """The text that another program would paste."""
    atom = screen.intern_atom
    reader = screen.screen().root.create_window(0, 0, 1, 1, 0, X.CopyFromParent)
    place = atom("DOLLYTRACK_TEST")
    try:
        reader.convert_selection(atom("CLIPBOARD"), atom("UTF8_STRING"), place, X.CurrentTime)
        screen.sync()
        let_owner_answer()
        for one in events(screen, 10):
            if one.type == X.SelectionNotify:
                if one.property == X.NONE:
                    return ""
                found = reader.get_full_property(place, X.AnyPropertyType)
                value = found.value if found is not None else b""
                return value.decode() if isinstance(value, bytes) else value
    finally:
        reader.destroy()
        screen.sync()
    raise AssertionError("nobody answers for the clipboard")

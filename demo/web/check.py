#!/usr/bin/env python3
"""Opens the demo's page in a headless Chromium, as on a desk and as on a phone, presses keys and buttons, and checks
what the demo says of its state: demo/web/check.py FOLDER [PICTURE.png [DEMO]]

The picture of the phone is saved beside the other, as PICTURE-phone.png. With the program DEMO, built for this machine, an
address is opened there as well, and must come to the same bits.

Speaks the browser's own debugging protocol over a WebSocket; needs nothing but python3 and chromium.
"""

import base64
import functools
import http.server
import json
import os
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import threading
import time
import urllib.request

PATIENCE = 90.0  # Seconds; a software renderer takes its time.
HEADER = 30  # Pixels of the page above the canvas.
SIZE = (1280, 720 + HEADER)
PHONE = (390, 844)


class Browser:
    """A page in a headless Chromium, and what its console has said."""

    def __init__(self, address, profile):
        name = next(n for n in ("chromium", "chromium-browser", "google-chrome") if shutil.which(n))
        flags = ["--headless", "--no-sandbox", "--enable-unsafe-swiftshader", "--disable-quic", "--no-first-run",
                 "--disable-background-networking", "--disable-component-update", "--disable-sync",
                 f"--user-data-dir={profile}", f"--window-size={SIZE[0]},{SIZE[1] + 143}",
                 "--remote-debugging-port=0"]
        self.process = subprocess.Popen([name, *flags, "about:blank"], stderr=subprocess.DEVNULL,
                                        stdout=subprocess.DEVNULL)
        port = self._port(profile)
        pages = json.load(urllib.request.urlopen(f"http://127.0.0.1:{port}/json/list"))
        target = next(page for page in pages if page["type"] == "page")["webSocketDebuggerUrl"]
        self._connect(port, target.split(str(port), 1)[1])
        self.last_id = 0
        self.state = {}
        self.errors = []
        for domain in ("Runtime.enable", "Page.enable"):
            self.call(domain)
        self.call("Emulation.setDeviceMetricsOverride", width=SIZE[0], height=SIZE[1], deviceScaleFactor=1,
                  mobile=False)
        self.open(address)

    @staticmethod
    def _port(profile):
        path = os.path.join(profile, "DevToolsActivePort")
        until = time.monotonic() + PATIENCE
        while time.monotonic() < until:
            if os.path.exists(path) and (lines := open(path).read().split()):
                return int(lines[0])
            time.sleep(0.1)
        sys.exit("the browser did not start")

    def _connect(self, port, path):
        self.socket = socket.create_connection(("127.0.0.1", port))
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall((f"GET {path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nUpgrade: websocket\r\n"
                             f"Connection: Upgrade\r\nSec-WebSocket-Key: {key}\r\n"
                             "Sec-WebSocket-Version: 13\r\n\r\n").encode())
        answer = b""
        while not answer.endswith(b"\r\n\r\n"):
            answer += self.socket.recv(1)
        assert b" 101 " in answer, answer

    def _send(self, text):
        data = text.encode()
        length = len(data)
        if length < 126:
            head = bytes([0x81, 0x80 | length])
        elif length < 1 << 16:
            head = bytes([0x81, 0x80 | 126]) + length.to_bytes(2, "big")
        else:
            head = bytes([0x81, 0x80 | 127]) + length.to_bytes(8, "big")
        # A mask of zeros is a mask.
        self.socket.sendall(head + bytes(4) + data)

    def _exactly(self, count):
        data = b""
        while len(data) < count:
            part = self.socket.recv(count - len(data))
            if not part:
                sys.exit("the browser is gone")
            data += part
        return data

    def _receive(self):
        data = b""
        while True:
            first, second = self._exactly(2)
            length = second & 127
            if length > 125:
                length = int.from_bytes(self._exactly(2 if length == 126 else 8), "big")
            data += self._exactly(length)
            if first & 0x80:
                return json.loads(data)

    def _note(self, message):
        method, params = message.get("method"), message.get("params", {})
        if method == "Runtime.exceptionThrown":
            self.errors.append(params["exceptionDetails"].get("text", "?"))
        if method == "Runtime.consoleAPICalled":
            text = " ".join(str(word.get("value", "")) for word in params["args"])
            if params["type"] == "error":
                self.errors.append(text)
            if "state scene=" in text:
                self.state = dict(re.findall(r"(\w+)=(\S+)", text))

    def call(self, method, **params):
        self.last_id += 1
        self._send(json.dumps({"id": self.last_id, "method": method, "params": params}))
        while True:
            message = self._receive()
            self._note(message)
            if message.get("id") == self.last_id:
                return message.get("result", {})

    def open(self, address):
        """Opens an address in a page of its own, as the state of the one before says nothing about it."""
        self.call("Page.navigate", url="about:blank")
        self.call("Page.navigate", url=address)
        self.state = {}

    def hold_a_phone(self):
        self.call("Emulation.setDeviceMetricsOverride", width=PHONE[0], height=PHONE[1], deviceScaleFactor=2,
                  mobile=True)
        self.call("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=2)

    def evaluate(self, expression):
        return self.call("Runtime.evaluate", expression=expression)["result"].get("value")

    def touch(self, kind, *places):
        points = [{"x": x, "y": y + HEADER, "id": number} for number, (x, y) in enumerate(places)]
        self.call("Input.dispatchTouchEvent", type=kind, touchPoints=points)
        time.sleep(0.15)

    def tap(self, x, y):
        print(f"tap {x} {y}")
        self.touch("touchStart", (x, y))
        self.touch("touchEnd")

    def move_fingers(self, *paths):
        """Fingers down at the beginning of their paths, along them, and up."""
        print(f"fingers {paths}")
        parts = [0.0, 0.25, 0.5, 0.75, 1.0]
        for kind, part in zip(["touchStart"] + 4 * ["touchMove"], parts):
            self.touch(kind, *[[a + part * (b - a) for a, b in zip(start, end)] for start, end in paths])
        self.touch("touchEnd")

    def wait(self, what, is_so):
        """Waits until the state is as it should be."""
        until = time.monotonic() + PATIENCE
        while not is_so(self.state):
            if time.monotonic() > until or self.errors:
                sys.exit(f"FAILED: {what}; state {self.state}, errors {self.errors}")
            self.call("Runtime.evaluate", expression="0")
            time.sleep(0.05)
        print(f"  {what}")

    def key(self, key, code, number):
        print(f"key {key}")
        held = {"key": key, "code": code, "windowsVirtualKeyCode": number}
        self.call("Input.dispatchKeyEvent", type="keyDown", **held)
        time.sleep(0.3)
        self.call("Input.dispatchKeyEvent", type="keyUp", **held)

    def mouse(self, kind, x, y, button="none"):
        buttons = {"left": 1, "none": 0}[button]
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y + HEADER, button=button, buttons=buttons, clickCount=1)
        time.sleep(0.3)

    def click(self, x, y):
        print(f"click {x} {y}")
        self.mouse("mouseMoved", x, y)
        self.mouse("mousePressed", x, y, "left")
        self.mouse("mouseReleased", x, y, "left")

    def close(self):
        self.process.terminate()
        self.process.wait()


def check(page, picture):
    page.wait("it runs", lambda state: int(state.get("tick", 0)) > 0)
    page.wait("in the size of the page", has(size=f"{SIZE[0]}x{SIZE[1] - HEADER}"))
    page.key("c", "KeyC", 67)
    page.wait("contacts are shown", has(overlays="contacts"))
    page.key(" ", "Space", 32)
    page.wait("it is paused", has(paused="yes"))
    tick = int(page.state["tick"])
    page.key("s", "KeyS", 83)
    page.wait("a single tick later", lambda state: int(state["tick"]) > tick)
    page.click(1160, 98)
    page.wait("the button lets it run", has(paused="no"))
    page.click(1079, 180)
    page.wait("the scenes are listed", has(tab="Scenes"))
    bodies = int(page.state["bodies"])
    page.key("2", "Digit2", 50)
    page.wait("circles are made", has(tool="circle"))
    page.click(500, 60)
    page.wait("one more body", lambda state: int(state["bodies"]) == bodies + 1)
    scene = page.state["scene"]
    page.key("n", "KeyN", 78)
    page.wait("the next scene", lambda state: state["scene"] != scene)
    page.wait("it runs as well", lambda state: int(state["tick"]) > 30)
    save(page, picture)
    address = page.evaluate("location.hash")
    assert page.state["scene"] in address and "contacts" in address, address
    print(f"  the address follows: {address}")
    menu = "new MouseEvent('contextmenu', {cancelable: true, bubbles: true})"
    assert page.evaluate(f"document.querySelector('canvas').dispatchEvent({menu})") is False
    print("  the right button opens no menu")


def check_address(page, base):
    page.open(base + "#scene=galaxy&seed=3&overlays=boxes,grid&compare")
    page.wait("an address opens its state", has(scene="galaxy", seed="3", overlays="boxes,grid", copies="2"))
    page.open(base + "#scene=bounce&overlays=none")
    page.wait("without the overlays of the scene", has(scene="bounce", overlays="-"))
    page.wait("it runs there, and its letters are drawn", lambda state: int(state["tick"]) > 30)
    page.open(base + "#scene=nowhere")
    page.wait("one that makes no sense opens the first scene", has(scene="pile"))


def check_bits(page, base, demo):
    """What an address opens runs on to the same state in the browser as in a program."""
    page.open(base + "#scene=ball_pit&seed=5")
    page.wait("an address runs on", lambda state: int(state.get("tick", 0)) > 100)
    page.key(" ", "Space", 32)
    page.wait("until it is paused", has(paused="yes"))
    state = page.state
    command = [demo, "--headless", "--scene", "ball_pit", "--seed", "5", "--ticks", state["tick"]]
    said = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    digits, mean = re.search(r"state hash +(\w+)", said)[1], re.search(r"step +([\d.]+) ms", said)[1]
    assert state["hash"] == digits, (state, said)
    print(f"  the same bits in both: {state['hash']} after {state['tick']} ticks")
    print(f"  a step: {state['step_ms']} ms of late in the browser, {mean} ms as a mean here")


def check_phone(page, base, picture):
    page.hold_a_phone()
    page.open(base + "#scene=tower")
    height = PHONE[1] - HEADER
    page.wait("it fits a phone", has(size=f"{PHONE[0]}x{height}", folded="yes"))
    page.wait("it runs there", lambda state: int(state["tick"]) > 20)
    save(page, picture and picture.replace(".png", "-phone.png"))
    page.move_fingers(((190, 300), (190, 120)))
    page.wait("a finger drags what it is on", lambda state: int(state["edits"]) == 1)
    zoom = float(page.state["zoom"])
    page.move_fingers(((150, 200), (90, 200)), ((230, 200), (310, 200)))
    page.wait("two fingers zoom", lambda state: float(state["zoom"]) > 1.8 * zoom)
    page.tap(105, height - 22)
    page.wait("a page of the panel opens", has(tab="Scenes", folded="no"))
    top = height - round(0.48 * height)
    page.move_fingers(((150, height - 40), (150, top + 160)))
    page.wait("a finger scrolls it", lambda state: int(state["scroll"]) > 100)
    assert page.state["scene"] == "tower", "scrolling has chosen a scene"
    page.tap(150, height - 100)
    page.wait("a tap chooses a scene", lambda state: state["scene"] != "tower")
    save(page, picture and picture.replace(".png", "-panel.png"))


def has(**wanted):
    return lambda state: all(state.get(word) == value for word, value in wanted.items())


def save(page, picture):
    shot = base64.b64decode(page.call("Page.captureScreenshot")["data"])
    if picture:
        with open(picture, "wb") as file:
            file.write(shot)


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    handler = functools.partial(http.server.SimpleHTTPRequestHandler, directory=sys.argv[1])
    http.server.SimpleHTTPRequestHandler.log_message = lambda *_: None
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        base = f"http://127.0.0.1:{server.server_port}/"
        picture = sys.argv[2] if len(sys.argv) > 2 else None
        page = Browser(base, profile)
        try:
            check(page, picture)
            check_address(page, base)
            if len(sys.argv) > 3:
                check_bits(page, base, sys.argv[3])
            check_phone(page, base, picture)
            assert not page.errors, page.errors
            print("all of it holds")
        finally:
            page.close()


if __name__ == "__main__":
    main()

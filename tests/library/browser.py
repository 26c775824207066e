# SPDX-FileCopyrightText: 2026 LSDCD contributors
# SPDX-License-Identifier: BSD-3-Clause

"""Opens pages in browsers of Debian without a window: Chromium through a pipe, Firefox through Marionette, both in JSON."""
import base64
import fcntl
import json
import os
import pathlib
import shutil
import socket
import subprocess
import time

LONG = 120    # seconds that a page may take


class Browser:
    """What both have. `script` of run() is an expression."""

    def wait_for(self, expression, what):
        """The expression's value, once it is true."""
        return self.once(expression, bool, what)

    def once(self, expression, is_it=lambda value: value is not None, what="an answer"):
        """The expression's value, once it has one of this kind. A page that is being loaded has none."""
        end = time.time() + LONG
        while time.time() < end:
            try:
                value = self.run(expression)
            except RuntimeError:    # the page is being loaded
                pass
            else:
                if is_it(value):
                    return value
            time.sleep(0.1)
        raise AssertionError(f"{what} has not come in {LONG} s")

    def open(self, path):
        self.go(pathlib.Path(path).resolve().as_uri())
        return self.wait_for("document.body && document.body.dataset.ready", f"the page {path}")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait()


class Chromium(Browser):
    program = shutil.which("chromium") or ""

    def __init__(self, folder):
        to_read, own_writing = os.pipe()
        own_reading, to_write = os.pipe()

        def as_3_and_4():
            ends = [fcntl.fcntl(end, fcntl.F_DUPFD, 50) for end in (to_read, to_write)]
            for end, number in zip(ends, (3, 4)):
                os.dup2(end, number)

        self.process = subprocess.Popen(
            [self.program, "--headless=new", "--no-sandbox", "--remote-debugging-pipe", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
             "--disable-gpu-sandbox", "--hide-scrollbars", f"--user-data-dir={folder}", "about:blank"],
            close_fds=False, preexec_fn=as_3_and_4, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.writing, self.reading = own_writing, os.fdopen(own_reading, "rb")
        for end in (to_read, to_write):
            os.close(end)
        self.asked, self.session, self.events = 0, None, []
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(domain + ".enable")

    def call(self, method, **words):
        self.asked += 1
        message = {"id": self.asked, "method": method, "params": words, **({"sessionId": self.session} if self.session else {})}
        os.write(self.writing, json.dumps(message).encode() + b"\0")
        while True:
            answer = b""
            while not answer.endswith(b"\0"):
                byte = self.reading.read(1)
                if not byte:
                    raise AssertionError("Chromium has ended")
                answer += byte
            answer = json.loads(answer[:-1])
            if answer.get("id") != self.asked:
                self.events.append(answer)
            elif "error" in answer:
                raise RuntimeError(answer["error"])
            else:
                return answer["result"]

    def run(self, expression):
        answer = self.call("Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in answer:
            raise RuntimeError(answer["exceptionDetails"])
        return answer["result"].get("value")

    def look(self, width, dark):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=900, deviceScaleFactor=1, mobile=width < 600)
        self.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}])

    def go(self, address):
        self.call("Page.navigate", url=address)

    def drag(self, begin, end):
        for kind, (x, y), buttons in (("mousePressed", begin, 1), ("mouseMoved", end, 1), ("mouseReleased", end, 0)):
            self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", buttons=buttons, clickCount=1)

    def picture(self):
        return base64.b64decode(self.call("Page.captureScreenshot", captureBeyondViewport=True)["data"])

    def errors(self):
        told = []
        for event in self.events:
            if event["method"] == "Runtime.exceptionThrown":
                told.append(str(event["params"]["exceptionDetails"]))
            elif event["method"] == "Runtime.consoleAPICalled" and event["params"]["type"] == "error":
                told.append(str(event["params"]["args"]))
            elif event["method"] == "Log.entryAdded" and event["params"]["entry"]["level"] == "error":
                told.append(event["params"]["entry"]["text"])
        return told

    def requests(self):
        """Addresses that were asked for, without those that are data."""
        asked = [event["params"]["request"]["url"] for event in self.events if event["method"] == "Network.requestWillBeSent"]
        return [address for address in asked if not address.startswith(("data:", "blob:", "about:"))]


class Screen:
    """A screen of Xvfb (Debian: xvfb), on which Firefox has WebGL; without Xvfb it has none."""

    def __init__(self):
        self.process, self.name = None, ""
        if shutil.which("Xvfb"):
            reading, writing = os.pipe()
            self.process = subprocess.Popen(["Xvfb", "-displayfd", str(writing), "-screen", "0", "1600x1200x24", "-nolisten", "tcp"], pass_fds=[writing],
                                            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            os.close(writing)
            with os.fdopen(reading) as told:
                self.name = f":{told.readline().strip()}"

    def end(self):
        if self.process:
            self.process.terminate()
            self.process.wait()


class Firefox(Browser):
    program = shutil.which("firefox-esr") or ""

    def __init__(self, folder):
        profile = pathlib.Path(folder)
        profile.mkdir(parents=True, exist_ok=True)
        prefs = {"marionette.port": 0, "devtools.console.stdout.content": True, "browser.shell.checkDefaultBrowser": False, "webgl.force-enabled": True,
                 "datareporting.policy.dataSubmissionEnabled": False, "app.update.enabled": False, "browser.startup.page": 0,
                 "network.captive-portal-service.enabled": False, "network.connectivity-service.enabled": False}
        (profile / "user.js").write_text("".join(f'user_pref("{name}", {json.dumps(value)});\n' for name, value in prefs.items()))
        self.told = open(profile / "told.txt", "w+", encoding="utf-8", errors="replace")
        self.screen = Screen()
        where = {"DISPLAY": self.screen.name} if self.screen.name else {"MOZ_HEADLESS": "1"}
        self.process = subprocess.Popen([self.program, "--marionette", "--remote-allow-system-access", "--no-remote", "--profile", profile],
                                        stdout=self.told, stderr=subprocess.STDOUT,
                                        env={**os.environ, **where, "HOME": str(profile), "MOZ_DISABLE_CONTENT_SANDBOX": "1"})
        port, end = profile / "MarionetteActivePort", time.time() + LONG
        while not (port.exists() and port.read_text().strip()):
            if time.time() > end or self.process.poll() is not None:
                raise AssertionError("Firefox does not start")
            time.sleep(0.1)
        self.socket = socket.create_connection(("127.0.0.1", int(port.read_text())), timeout=LONG)
        self.asked, self.rest = 0, b""
        self.message()    # who answers
        self.call("WebDriver:NewSession")

    def __exit__(self, *_):
        super().__exit__()
        self.screen.end()

    def message(self):
        while b":" not in self.rest:
            self.rest += self.socket.recv(65536)
        length, _, self.rest = self.rest.partition(b":")
        while len(self.rest) < int(length):
            self.rest += self.socket.recv(65536)
        text, self.rest = self.rest[:int(length)], self.rest[int(length):]
        return json.loads(text)

    def call(self, method, **words):
        self.asked += 1
        text = json.dumps([0, self.asked, method, words]).encode()
        self.socket.sendall(str(len(text)).encode() + b":" + text)
        _, _, error, result = self.message()
        if error:
            raise RuntimeError(error)
        return result

    def run(self, expression):
        return self.call("WebDriver:ExecuteScript", script=f"return ({expression});", args=[], sandbox=None)["value"]

    def look(self, width, dark):
        """The window, which Firefox makes no narrower than 450 or so."""
        self.call("WebDriver:SetWindowRect", width=width, height=900)
        self.call("Marionette:SetContext", value="chrome")
        self.call("WebDriver:ExecuteScript", script=f"Services.prefs.setIntPref('layout.css.prefers-color-scheme.content-override', {0 if dark else 1});", args=[])
        self.call("Marionette:SetContext", value="content")

    def go(self, address):
        self.call("WebDriver:Navigate", url=address)

    def drag(self, begin, end):
        move = [{"type": "pointerMove", "duration": 0, "x": begin[0], "y": begin[1]}, {"type": "pointerDown", "button": 0},
                {"type": "pointerMove", "duration": 50, "x": end[0], "y": end[1]}, {"type": "pointerUp", "button": 0}]
        self.call("WebDriver:PerformActions", actions=[{"type": "pointer", "id": "mouse", "actions": move}])

    def picture(self):
        return base64.b64decode(self.call("WebDriver:TakeScreenshot", full=True)["value"])

    def errors(self):
        self.told.flush()
        lines = pathlib.Path(self.told.name).read_text(encoding="utf-8", errors="replace").splitlines()
        return [line for line in lines if "console.error" in line and "report.html" in line or "JavaScript error: file:" in line]

    def requests(self):
        return self.run("[location.href, ...performance.getEntriesByType('resource').map(e => e.name)].filter(a => !/^(data|blob|about):/.test(a))")

"""A real browser, driven by DevTools messages over a pipe: no port, no driver program, the standard library alone.

One `Browser` is a process; each of its `Page`s has storage of its own. Nothing here sleeps: what must come to be true is
waited for inside of the page.
"""
import base64
import fcntl
import json
import os
import pathlib
import select
import shutil
import signal
import subprocess
import tempfile
import time
import urllib.parse

PATIENCE = int(os.environ.get("SWARMSMITH_PATIENCE", "1"))
PROGRAMS = ("chromium-headless-shell", "chromium")
KEYS = {"Backspace": 8, "Tab": 9, "Enter": 13, "Escape": 27, "End": 35, "Home": 36, "ArrowLeft": 37, "ArrowUp": 38,
        "ArrowRight": 39, "ArrowDown": 40, "Delete": 46}


def program():
    """Path of the browser, or None where there is none."""
    return next(filter(None, map(shutil.which, PROGRAMS)), None)


class BrowserError(AssertionError):
    """What the browser refused, or what did not come to be in time."""


class Browser:
    def __init__(self):
        self.folder = tempfile.TemporaryDirectory(prefix="swarmsmith-browser-", ignore_cleanup_errors=True)
        to_read, self.to = os.pipe()
        self.back, to_write = os.pipe()
        # The browser reads descriptor 3 and writes descriptor 4.
        ends = [fcntl.fcntl(end, fcntl.F_DUPFD, 10) for end in (to_read, to_write)]
        arguments = [program(), "--headless", "--remote-debugging-pipe", f"--user-data-dir={self.folder.name}",
                     "--no-first-run", "--disable-gpu", "--disable-dev-shm-usage", "--disable-background-networking",
                     "--disable-component-update", "--hide-scrollbars", "--force-color-profile=srgb"]
        arguments += ["--no-sandbox"] if os.geteuid() == 0 else []
        self.process = subprocess.Popen(
            arguments, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, pass_fds=(3, 4), start_new_session=True,
            preexec_fn=lambda: [os.dup2(end, number) for end, number in zip(ends, (3, 4))])
        for end in (to_read, to_write, *ends):
            os.close(end)
        self.read, self.number, self.pages = b"", 0, {}

    def close(self):
        try:
            self.call("Browser.close", timeout=10)
            self.process.wait(10 * PATIENCE)
        except (BrowserError, OSError, subprocess.TimeoutExpired):
            pass
        try:
            os.killpg(self.process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        self.process.wait()
        for end in (self.to, self.back):
            os.close(end)
        self.folder.cleanup()

    def call(self, method, session=None, timeout=30, **parameters):
        """Sends a command; returns its result. What happens in the meantime goes to its page."""
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters, **({"sessionId": session} if session else {})}
        data = json.dumps(message).encode() + b"\0"
        while data:
            data = data[os.write(self.to, data):]
        end = time.monotonic() + timeout * PATIENCE
        while True:
            answer = self._message(end, method)
            if answer.get("id") == self.number:
                if "error" in answer:
                    raise BrowserError(f"{method}: {answer['error']['message']}")
                return answer["result"]
            if answer.get("sessionId") in self.pages:
                self.pages[answer["sessionId"]].happened(answer["method"], answer["params"])

    def _message(self, end, method):
        while b"\0" not in self.read:
            if not select.select([self.back], [], [], max(0, end - time.monotonic()))[0]:
                raise BrowserError(f"{method}: no answer of the browser in time")
            more = os.read(self.back, 1 << 20)
            if not more:
                raise BrowserError(f"{method}: the browser has ended")
            self.read += more
        message, self.read = self.read.split(b"\0", 1)
        return json.loads(message)

    def page(self, width=1440, height=900):
        context = self.call("Target.createBrowserContext")["browserContextId"]
        target = self.call("Target.createTarget", url="about:blank", browserContextId=context)["targetId"]
        session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        return Page(self, context, session, width, height)


class Page:
    def __init__(self, browser, context, session, width, height):
        self.browser, self.context, self.session = browser, context, session
        self.said, self.requests = [], []
        browser.pages[session] = self
        for domain in ("Page", "Runtime", "Log", "Network", "Accessibility"):
            self.call(f"{domain}.enable")
        self.viewport(width, height)

    def call(self, method, **parameters):
        return self.browser.call(method, self.session, **parameters)

    def close(self):
        if self.browser.pages.pop(self.session, None):
            self.browser.call("Target.disposeBrowserContext", browserContextId=self.context)

    def happened(self, method, event):
        if method == "Runtime.exceptionThrown":
            details = event["exceptionDetails"]
            self.said.append(details.get("exception", {}).get("description", details["text"]))
        elif method == "Runtime.consoleAPICalled" and event["type"] in ("error", "warning", "assert"):
            self.said.append(" ".join(str(a.get("value", a.get("description"))) for a in event["args"]))
        elif method == "Log.entryAdded" and event["entry"]["level"] in ("error", "warning"):
            self.said.append(event["entry"]["text"] + " " + event["entry"].get("url", ""))
        elif method == "Network.requestWillBeSent":
            self.requests.append(event["request"]["url"])

    def open(self, url, expression="true"):
        """Goes to an address and waits until `expression` is true there."""
        self.call("Page.navigate", url=url)
        self.wait(f"document.readyState === 'complete' && ({expression})")

    def js(self, expression):
        """Value of an expression of the page; a promise's is waited for."""
        answer = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in answer:
            details = answer["exceptionDetails"]
            raise BrowserError(details.get("exception", {}).get("description", details["text"]) + "\nin " + expression)
        return answer["result"].get("value")

    def wait(self, expression, timeout=20):
        """Waits, inside of the page, until an expression is true; returns its value."""
        end = time.monotonic() + timeout * PATIENCE
        waiting = """new Promise(done => { const end = Date.now() + 2000; (function look() {
            let value; try { value = (%s) } catch (error) { value = undefined }
            if (value || Date.now() > end) done(value instanceof Node ? true : value); else setTimeout(look, 15) })() })""" % expression
        while time.monotonic() < end:
            try:
                value = self.js(waiting)
            except BrowserError as error:
                # The page went elsewhere meanwhile.
                if not any(words in str(error) for words in ("context", "navigat", "Promise was collected")):
                    raise
                value = None
            if value:
                return value
        raise BrowserError(f"not true in time: {expression}\nerrors: {self.said}\npage says: "
                           + self.js("location.href + '\\n' + document.body.innerText")[:1500])

    def click(self, selector, right=0.5, down=0.5):
        """A click into an element, at parts of its width and height."""
        x, y = self.wait("""(() => { const it = document.querySelector(%s); if (!it) return null;
            it.scrollIntoView({block: 'center', inline: 'center', behavior: 'instant'});
            const box = it.getBoundingClientRect(); if (!box.width) return null;
            return [box.x + box.width * %s, box.y + box.height * %s] })()""" % (json.dumps(selector), right, down))
        self.mouse("mouseMoved", x, y)
        self.mouse("mousePressed", x, y)
        self.mouse("mouseReleased", x, y)

    def mouse(self, kind, x, y):
        pressed = {} if kind == "mouseMoved" else {"button": "left", "clickCount": 1}
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, **pressed)

    def key(self, key, shift=False):
        """Presses and releases a key: a letter, or a name of `KEYS`."""
        text = {"Enter": "\r"}.get(key, key if len(key) == 1 else "")
        same = {"key": key, "modifiers": 8 if shift else 0, "windowsVirtualKeyCode": KEYS.get(key, 0)}
        self.call("Input.dispatchKeyEvent", type="keyDown" if text else "rawKeyDown", text=text, **same)
        self.call("Input.dispatchKeyEvent", type="keyUp", **same)

    def errors(self):
        """What the page or the browser complained of since the last call."""
        self.js("0")
        said, self.said = self.said, []
        return said

    def hosts(self):
        """Hosts, with ports, that anything was asked of."""
        parts = map(urllib.parse.urlsplit, self.requests)
        return {part.netloc for part in parts if part.scheme not in ("data", "blob", "file", "about")}

    def shot(self, path, whole=True):
        kind = pathlib.Path(path).suffix[1:]
        data = self.call("Page.captureScreenshot", format=kind, captureBeyondViewport=whole)["data"]
        pathlib.Path(path).write_bytes(base64.b64decode(data))

    def media(self, dark=False, calm=False):
        self.call("Emulation.setEmulatedMedia", features=[
            {"name": "prefers-color-scheme", "value": "dark" if dark else "light"},
            {"name": "prefers-reduced-motion", "value": "reduce" if calm else "no-preference"}])

    def viewport(self, width, height=900):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)

    def tree(self):
        """Nodes of the accessibility tree that a screen reader meets."""
        return [node for node in self.call("Accessibility.getFullAXTree")["nodes"] if not node.get("ignored")]

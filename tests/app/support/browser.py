"""A headless Chromium that opens pages from the disk and is controlled with real mouse and key
events."""
import json
import os
import shutil
import tempfile
import unittest

import cv2
import numpy as np

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
except ImportError:
    webdriver = None

FLAGS = ["--headless=new", "--no-sandbox", "--disable-gpu", "--use-gl=angle",
         "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-quic",
         "--no-first-run", "--disable-background-networking", "--disable-component-update",
         "--disable-sync", "--hide-scrollbars", "--force-color-profile=srgb"]


def need_browser():
    """Skips the test when no browser is installed, or fails it where every reader is required."""
    programs = {"chromium": "chromium", "chromedriver": "chromium-driver"}
    missing = [package for name, package in programs.items() if not shutil.which(name)]
    if webdriver is None:
        missing.append("python3-selenium")
    if not missing:
        return
    message = f"no browser: install {', '.join(missing)}"
    if os.environ.get("DOLLYTRACK_REQUIRE_READERS") == "1":
        raise AssertionError(message)
    raise unittest.SkipTest(message)


def decoded(data):
    """An image file's bytes as BGR."""
    return cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_COLOR)


def difference(one, other):
    """Mean absolute difference of two images, the second scaled to the size of the first."""
    height, width = one.shape[:2]
    if height < other.shape[0]:
        other = cv2.resize(other, (width, height), interpolation=cv2.INTER_AREA)
    else:
        other = cv2.resize(other, (width, height), interpolation=cv2.INTER_LINEAR)
    return float(np.abs(one.astype(float) - other).mean())


class Browser:
    def __init__(self, *flags):
        need_browser()
        self.profile = tempfile.mkdtemp(prefix="dollytrack_browser")
        options = webdriver.ChromeOptions()
        options.binary_location = shutil.which("chromium")
        for flag in (*FLAGS, f"--user-data-dir={self.profile}", *flags):
            options.add_argument(flag)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        self.driver = webdriver.Chrome(service=Service(shutil.which("chromedriver")),
                                       options=options)
        self.driver.set_script_timeout(60)
        self.driver.get("about:blank")
        self.driver.get_log("performance")  # of the browser's own first page
        self.requests, self.errors = [], []

    def close(self):
        self.driver.quit()
        shutil.rmtree(self.profile, ignore_errors=True)

    def look(self, width=1280, height=800, dark=False):
        """The window's size and the user's preference for colours."""
        command = self.driver.execute_cdp_cmd
        command("Emulation.setDeviceMetricsOverride", {
            "width": width, "height": height, "deviceScaleFactor": 1, "mobile": False})
        command("Emulation.setEmulatedMedia", {"features": [
            {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}]})

    def open(self, page, address=""):
        self.driver.get("about:blank")
        self.driver.get(page.resolve().as_uri() + address)
        self.settle()

    def run(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def settle(self):
        """Waits until all requested changes are drawn."""
        self.driver.execute_async_script(
            "const done = arguments[0];"
            "requestAnimationFrame(() => requestAnimationFrame(() => done()));")

    def find(self, selector):
        return self.driver.find_element(By.CSS_SELECTOR, selector)

    def texts(self, selector):
        """The visible texts of elements; empty for hidden ones."""
        return [one.text for one in self.driver.find_elements(By.CSS_SELECTOR, selector)]

    def text(self, selector):
        return self.find(selector).text

    def click(self, selector):
        self.find(selector).click()
        self.settle()

    def click_at(self, x, y):
        chain = ActionChains(self.driver)
        chain.w3c_actions.pointer_action.move_to_location(round(x), round(y))
        chain.w3c_actions.pointer_action.click()
        chain.perform()
        self.settle()

    def drag(self, x, y, across, down):
        chain = ActionChains(self.driver)
        pointer = chain.w3c_actions.pointer_action
        pointer.move_to_location(x, y)
        pointer.pointer_down()
        for part in (0.5, 1.0):
            pointer.move_to_location(round(x + part * across), round(y + part * down))
        pointer.pointer_up()
        chain.perform()
        self.settle()

    def press(self, *keys):
        ActionChains(self.driver).send_keys(*keys).perform()
        self.settle()

    def picture(self, selector):
        """A screenshot of an element, BGR."""
        return decoded(self.find(selector).screenshot_as_png)

    def note_logs(self):
        """Records network requests and script errors since the last call."""
        for entry in self.driver.get_log("performance"):
            message = json.loads(entry["message"])["message"]
            if message["method"] == "Network.requestWillBeSent":
                self.requests.append(message["params"]["request"]["url"])
        self.errors += [entry["message"] for entry in self.driver.get_log("browser")
                        if entry["level"] == "SEVERE"]

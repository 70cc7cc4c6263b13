"""Shared by the tests of pages: a browser (chromium, python3-selenium), checks, screenshots."""
from selenium import webdriver
from selenium.webdriver.chrome.service import Service


def browser():
    options = webdriver.ChromeOptions()
    for word in ("--headless=new", "--no-sandbox", "--disable-gpu", "--window-size=1240,1000",
                 "--force-device-scale-factor=1", "--hide-scrollbars"):
        options.add_argument(word)
    options.binary_location = "/usr/bin/chromium"
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)


def check(what, holds):
    print(("ok      " if holds else "WRONG   ") + what)
    check.all = check.all and bool(holds)


check.all = True


def screenshots(driver, page, folder):
    folder.mkdir(parents=True, exist_ok=True)
    driver.get(page.as_uri())
    height = driver.execute_script("return document.body.scrollHeight")
    driver.set_window_size(1240, min(height + 100, 6000))
    driver.save_screenshot(str(folder / "page.png"))
    driver.execute_cdp_cmd("Emulation.setEmulatedMedia",
                           {"features": [{"name": "prefers-color-scheme", "value": "dark"}]})
    driver.save_screenshot(str(folder / "page-dark.png"))
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                           {"width": 420, "height": 2400, "deviceScaleFactor": 1, "mobile": True})
    driver.save_screenshot(str(folder / "page-narrow.png"))

#!/usr/bin/python3
"""Tests the page of `rend diff` in a real browser (chromium, chromium-driver, python3-selenium).

    diff.py REND [DIR]     DIR: where to keep screenshots

Three pictures that differ, and one for each other state; it clicks every view, moves the slider, magnifies the
worst place and another one, and sorts a table. Results are read back as pixels of screenshots. Prints errors
and exits 1.
"""
import io
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from PIL import Image
from selenium import webdriver
from selenium.webdriver.common.by import By

from browser import browser, check, screenshots

WIDTH, HEIGHT = 320, 180


def pictures(folder):
    """The expected pictures are blue; the current ones also have a red square of 24 pixels, each elsewhere."""
    for side in ("a", "b"):
        (folder / side / "in").mkdir(parents=True)
    blue = np.zeros((HEIGHT, WIDTH, 3), np.uint8)
    blue[...] = (30, 60, 200)
    save = lambda name, image: Image.fromarray(image).save(folder / name)
    for n, name in enumerate(("one", "two", "in/three")):
        red = blue.copy()
        red[40 + 40 * n:64 + 40 * n, 200:224] = (220, 40, 30)
        save(f"a/{name}.png", blue)
        save(f"b/{name}.png", red)
    for name in ("same", "in/same"):
        save(f"a/{name}.png", blue)
        save(f"b/{name}.png", blue)
    save("a/missing.png", blue)
    save("b/new.png", blue)
    save("a/size.png", blue)
    save("b/size.png", blue[:90])
    save("a/torn.png", blue)
    (folder / "b/torn.png").write_bytes((folder / "a/torn.png").read_bytes()[:60])


def shot(element):
    return np.asarray(Image.open(io.BytesIO(element.screenshot_as_png)).convert("RGB")).astype(int)


def at(image, x, y):
    """The pixel of a view's screenshot at x, y in pixels of the picture (which is shown enlarged)."""
    return image[int((y + 0.5) / HEIGHT * image.shape[0]), int((x + 0.5) / WIDTH * image.shape[1])]


def is_like(pixel, colour):
    return np.abs(np.array(pixel) - colour).max() < 12


BLUE, RED, BLACK = (30, 60, 200), (220, 40, 30), (0, 0, 0)


def first_of_two(driver):
    """Tests each view of the picture `one`, whose square is at (200, 40)."""
    heading = next(h for h in driver.find_elements(By.TAG_NAME, "h3") if h.text == "one.png")
    box = heading.find_element(By.XPATH, "following-sibling::div[contains(@class, 'compare')]")
    stack = box.find_element(By.CLASS_NAME, "stack")
    driver.execute_script("arguments[0].scrollIntoView()", heading)
    click = lambda way: box.find_element(By.CSS_SELECTOR, f"button[data-way={way}]").click()
    slide = lambda value: driver.execute_script(
        "arguments[0].value = arguments[1]; arguments[0].dispatchEvent(new Event('input'))",
        box.find_element(By.CSS_SELECTOR, "input[type=range]"), value)

    check("it begins with the slider", box.get_attribute("data-way") == "slider")
    slide(20)
    check("slider to the left: what is there now", is_like(at(shot(stack), 212, 52), RED))
    slide(90)
    check("slider to the right: what is expected", is_like(at(shot(stack), 212, 52), BLUE))
    for way, colour in (("now", RED), ("expected", BLUE)):
        click(way)
        check(f"{way}: the one colour", is_like(at(shot(stack), 212, 52), colour))
        check(f"{way}: the other pixels as ever", is_like(at(shot(stack), 20, 150), BLUE))
    click("difference")
    seen = shot(stack)
    check("difference: black where they are equal", is_like(at(seen, 20, 150), BLACK))
    check("difference: bright where they are not", at(seen, 212, 52).max() > 200)
    click("heat")
    seen = shot(stack)
    check("heat map: dark and bright", at(seen, 20, 150).max() < 30 and at(seen, 212, 52).min() > 60)
    click("blink")
    colours = set()
    for _ in range(12):
        colours.add("red" if is_like(at(shot(stack), 212, 52), RED) else "blue")
        driver.execute_async_script("setTimeout(arguments[0], 250)")
    check("blink: both in turn", colours == {"red", "blue"})
    click("side")
    images = [i for i in stack.find_elements(By.TAG_NAME, "img") if i.is_displayed()]
    check("side by side: three pictures that do not overlap",
          len(images) == 3 and len({(i.rect["x"], i.rect["y"]) for i in images}) == 3)
    click("slider")
    return box, stack


def zoom(driver, box, stack):
    colour = lambda of, x, y: driver.execute_script(
        "var d = arguments[0].getContext('2d').getImageData(arguments[1], arguments[2], 1, 1).data;"
        "return [d[0], d[1], d[2]]", box.find_element(By.CSS_SELECTOR, f"canvas[data-of={of}]"), x, y)
    check("the worst place: red now, blue expected",
          is_like(colour("b", 224, 224), RED) and is_like(colour("a", 224, 224), BLUE))
    webdriver.ActionChains(driver).move_to_element_with_offset(stack, -200, 100).click().perform()
    check("a click enlarges another place", is_like(colour("b", 224, 224), BLUE))
    box.find_element(By.CLASS_NAME, "worst").click()
    check("and a button the worst again", is_like(colour("b", 224, 224), RED))


def tables(driver):
    table = lambda: driver.find_elements(By.CSS_SELECTOR, "table")[0]
    rows = lambda: [r.text.split()[0] for r in table().find_elements(By.CSS_SELECTOR, "tbody tr")]
    check("failures first, the worst state at the top", rows()[0] == "torn.png" and len(rows()) == 7)
    driver.find_elements(By.CSS_SELECTOR, "table")[0].find_element(By.TAG_NAME, "th").click()
    check("sorted by name after a click", rows() == sorted(rows()))
    driver.find_element(By.LINK_TEXT, "in/three.png").click()
    top = driver.execute_script(
        "return document.getElementById(location.hash.slice(1)).getBoundingClientRect().top")
    check("a link leads to the picture", -5 < top < 500)
    closed = driver.find_elements(By.TAG_NAME, "details")[-1]
    closed.find_element(By.TAG_NAME, "summary").click()
    check("what matches opens", "in/same.png" in closed.text)


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit("usage: diff.py REND [DIR]")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        pictures(folder)
        done = subprocess.run([sys.argv[1], "diff", folder / "a", folder / "b", "-o", folder / "report", "-q"])
        check("rend diff says that one cannot be read", done.returncode == 2)
        driver = browser()
        try:
            driver.get((folder / "report/index.html").as_uri())
            zoom(driver, *first_of_two(driver))
            tables(driver)
            said = [line["message"] for line in driver.get_log("browser")]
            wrong = [message for message in said if "readback" not in message]  # the test's own
            check(f"the browser has nothing to say {wrong}", not wrong)
            if len(sys.argv) == 3:
                screenshots(driver, folder / "report/index.html", Path(sys.argv[2]))
        finally:
            driver.quit()
    sys.exit(0 if check.all else 1)


main()

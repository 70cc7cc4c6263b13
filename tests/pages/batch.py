#!/usr/bin/python3
"""Tests the page of `rend batch` in a real browser (chromium, chromium-driver, python3-selenium).

    batch.py REND [DIR]     DIR: where to keep screenshots

Four jobs: two that are done, one that is unstable, one whose preset is bad. It reads tiles and states, checks
the pixels of each thumbnail, sorts columns by a click, and follows a link to the pictures. Prints errors and
exits 1.
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

from selenium.webdriver.common.by import By

from browser import browser, check, screenshots

PRESET = """<scene name="{name}">
  <body name="cloth"><sheet cells="6 6" size="1 1"/><place rotate="90 0 0"/><mass total="0.1"/>
    <springs><stretch k="{k}"/></springs><fix side="-x"/><drive side="+x" velocity="4 0 0"/>
    <tear criterion="global-border" threshold="2"/></body>
  <time step="{step}" integrator="{scheme}" duration="0.3"/>
  <image size="320 180" fps="20" samples="1"/>
</scene>"""


def batch(rend, folder):
    (folder / "presets/more").mkdir(parents=True)
    write = lambda name, **more: (folder / f"presets/{name}.xml").write_text(
        PRESET.format(**({"name": "clip", "k": 60, "step": "1e-3", "scheme": "rk4"} | more)))
    write("quick")
    write("more/slow", step="1e-5")
    write("unstable", k="1e13", step="1e-2", scheme="symplectic")
    (folder / "presets/bad.xml").write_text('<scene name="bad"><bdy/></scene>')
    done = subprocess.run([rend, "batch", folder / "presets", "-o", folder / "out", "--json", "-q"],
                          capture_output=True)
    check("rend batch says that jobs failed", done.returncode == 1)
    return {line["job"]: line for line in map(json.loads, done.stdout.splitlines())}


def rows(driver):
    return driver.find_elements(By.CSS_SELECTOR, "table.sortable tbody tr")


def column(driver, name):
    heads = driver.find_elements(By.CSS_SELECTOR, "table.sortable th")
    return next(n for n, head in enumerate(heads) if head.text.strip().startswith(name)), heads


def name_of(row):  # a job that failed has no link
    at, _ = column(row.parent, "job")
    return row.find_elements(By.TAG_NAME, "td")[at].text.split("\n")[0]


def states_and_pictures(driver, jobs):
    at, _ = column(driver, "state")
    seen = {name_of(row): row.find_elements(By.TAG_NAME, "td")[at].text for row in rows(driver)}
    check(f"the states of --json: {seen}", seen == {name: line["state"] for name, line in jobs.items()})
    check("failures first", {name_of(row) for row in rows(driver)[:2]} == {"bad", "unstable"})
    bad = next(row for row in rows(driver) if name_of(row) == "bad")
    check("why it failed, with its place", "bad.xml:1:19" in bad.text and "bdy" in bad.text)
    colours = """const i = arguments[0], c = document.createElement('canvas'); c.width = i.naturalWidth;
      c.height = i.naturalHeight; const x = c.getContext('2d'); x.drawImage(i, 0, 0);
      return new Set(new Uint32Array(x.getImageData(0, 0, c.width, c.height).data.buffer)).size"""
    for row in rows(driver):
        pictures = row.find_elements(By.TAG_NAME, "img")
        if jobs[name_of(row)].get("frames"):
            check(f"a picture of {name_of(row)}, of many colours",
                  len(pictures) == 1 and driver.execute_script(colours, pictures[0]) > 50)
        else:
            check(f"none of {name_of(row)}", not pictures)
    text = driver.find_element(By.TAG_NAME, "body").text
    check("how many were done and how many failed", "2\ndone" in text and "2\nfailed" in text)


def sorting(driver, jobs):
    at, heads = column(driver, "time")
    heads[at].click()
    once = [jobs[name_of(row)]["seconds"] for row in rows(driver)]
    heads[at].click()
    twice = [jobs[name_of(row)]["seconds"] for row in rows(driver)]
    check("sorted by time after a click, and the other way after another",
          once == sorted(once) and twice == sorted(twice, reverse=True))
    at, heads = column(driver, "job")
    heads[at].click()
    check("sorted by name", [name_of(row) for row in rows(driver)] == sorted(jobs))


def links(driver, page):
    driver.find_element(By.LINK_TEXT, "more/slow").click()
    check("a link leads to the pictures", "00003.png" in driver.find_element(By.TAG_NAME, "body").text)
    driver.get(page.as_uri())


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit("usage: batch.py REND [DIR]")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        jobs = batch(sys.argv[1], folder)
        page = folder / "out/index.html"
        driver = browser()
        try:
            driver.get(page.as_uri())
            states_and_pictures(driver, jobs)
            sorting(driver, jobs)
            said = [line["message"] for line in driver.get_log("browser")]
            wrong = [message for message in said if "readback" not in message]  # the test's own
            check(f"the browser has nothing to say {wrong}", not wrong)
            links(driver, page)
            if len(sys.argv) == 3:
                screenshots(driver, page, Path(sys.argv[2]))
        finally:
            driver.quit()
    sys.exit(0 if check.all else 1)


main()

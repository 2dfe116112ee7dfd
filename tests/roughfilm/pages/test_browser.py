"""Every kind of page in a browser: nothing fails, leaves the file, overflows or is cut; figures read, zoom and turn."""

import shutil

import pytest
from boxes import overlaps
from every_page import KINDS, made, small_scenes

CHROMIUM = shutil.which("chromium")
ARGUMENTS = ["--no-sandbox", "--disable-gpu", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]

WIDTHS = (1400, 800, 400)
PAPER = 703
"""Width of A4 between its margins, CSS pixels."""

MAX_BYTES = 5e6

OVERFLOWING = """() => {
  const found = [], edge = document.documentElement.clientWidth;
  if (document.documentElement.scrollWidth > edge + 1) found.push(`page ${document.documentElement.scrollWidth}`);
  const scrolls = (element) => ["auto", "scroll"].includes(getComputedStyle(element).overflowX);
  for (const element of document.querySelectorAll("main *")) {
    if (element.ownerSVGElement || !element.checkVisibility()) continue;
    let above = element.parentElement;
    while (above !== document.body && !scrolls(above)) above = above.parentElement;
    if (above !== document.body) continue;
    const own = element.getBoundingClientRect();
    const box = element.parentElement.closest("section, .card, main").getBoundingClientRect();
    if (own.width && (own.right > box.right + 1 || own.left < box.left - 1)) {
      found.push(`${element.tagName} ${element.textContent.trim().slice(0, 40)}: ${own.right} > ${box.right}`);
    }
  }
  return found;
}"""


@pytest.fixture(scope="module")
def pages(tmp_path_factory):
    """The page of a kind and what overlaps in its figures; made when it is first asked for."""
    folder, known = tmp_path_factory.mktemp("pages"), {}
    small_scenes(folder)

    def page_of(kind):
        if kind not in known:
            faults = []
            known[kind] = made(kind, folder, lambda figure: faults.extend(overlaps(figure))), faults
        return known[kind]

    return page_of


@pytest.fixture(scope="module")
def browser():
    if CHROMIUM is None:
        pytest.skip("chromium is not here: sudo apt-get install chromium")
    sync = pytest.importorskip("playwright.sync_api")
    with sync.sync_playwright() as run:
        started = run.chromium.launch(executable_path=CHROMIUM, args=ARGUMENTS)
        yield started
        started.close()


@pytest.fixture
def visit(browser, pages):
    """Open the page of a kind; afterwards nothing may have been reported or requested."""
    faults, contexts = [], []

    def opened(kind, **options):
        path = pages(kind)[0]
        contexts.append(browser.new_context(viewport={"width": WIDTHS[0], "height": 900}, **options))
        page = contexts[-1].new_page()
        page.on("console", lambda message: faults.append(message.text) if message.type == "error" else None)
        page.on("pageerror", lambda error: faults.append(str(error)))
        page.on("request", lambda request: faults.append(request.url) if _leaves(request.url, path) else None)
        page.goto(path.as_uri())
        return page

    yield opened
    for context in contexts:
        context.close()
    assert faults == []


def _leaves(url, path):
    return url != path.as_uri() and not url.startswith(("data:", "blob:", "about:"))


@pytest.mark.parametrize("kind", KINDS)
def test_nothing_overlaps_in_a_figure(kind, pages):
    assert pages(kind)[1] == []


@pytest.mark.parametrize("kind", KINDS)
def test_a_page_is_one_file_of_at_most_5_megabytes(kind, pages):
    assert pages(kind)[0].stat().st_size <= MAX_BYTES


@pytest.mark.parametrize("kind", KINDS)
def test_nothing_overflows_on_a_screen_or_on_paper(kind, visit):
    page = visit(kind)
    for width in WIDTHS:
        page.set_viewport_size({"width": width, "height": 900})
        assert page.evaluate(OVERFLOWING) == [], width
    page.emulate_media(media="print")
    page.set_viewport_size({"width": PAPER, "height": 900})
    assert page.evaluate(OVERFLOWING) == []


@pytest.mark.parametrize("kind", KINDS)
def test_figures_read_values_under_the_pointer_and_zoom(kind, visit):
    page = visit(kind)
    figures = page.locator("svg.readable")
    if kind != "stability":
        assert figures.count() > 0
    for figure in figures.all():
        assert _hovered(page, figure), "a point or a cell of each figure is read"
    if figures.count():
        figure = figures.first
        figure.scroll_into_view_if_needed()
        whole, box = figure.get_attribute("viewBox"), figure.bounding_box()
        page.mouse.move(box["x"] + 0.3 * box["width"], box["y"] + 0.3 * box["height"])
        page.mouse.down()
        page.mouse.move(box["x"] + 0.6 * box["width"], box["y"] + 0.6 * box["height"])
        page.mouse.up()
        part = [float(side) for side in figure.get_attribute("viewBox").split()]
        assert part[2] == pytest.approx(0.3 * float(whole.split()[2]), rel=0.05)
        page.mouse.dblclick(box["x"] + 0.5 * box["width"], box["y"] + 0.5 * box["height"])
        assert figure.get_attribute("viewBox").split() == whole.split()


def _hovered(page, figure):
    """What is read at the first point or in a cell of a figure, with its quantity."""
    figure.scroll_into_view_if_needed()
    place, words = figure.evaluate("""(svg) => {
      const panels = JSON.parse(svg.querySelector("metadata.readings").textContent);
      const panel = panels.find(({ series }) => series.length) ?? panels[0], [left, top, width, height] = panel.box;
      const cell = panel.map && panel.map.values.findIndex((value) => value !== null);
      const at = panel.series.length ? panel.series[0].points : [
        left + ((cell % panel.map.columns) + 0.5) * width / panel.map.columns,
        top + (Math.floor(cell / panel.map.columns) + 0.5) * height / panel.map.rows];
      const { x, y } = new DOMPoint(at[0], at[1]).matrixTransform(svg.getScreenCTM());
      return [[x, y], panel.map && !panel.series.length ? [panel.map] : [panel.x, panel.y]];
    }""")
    page.mouse.move(*place)
    reading = page.locator(".reading").inner_text()
    for quantity in words:
        if not quantity.get("places"):
            assert f"{quantity['name']}: " in reading
            assert quantity["unit"] in reading
    return reading


@pytest.mark.parametrize("kind", ["surface", "contact"])
def test_surfaces_turn(kind, visit):
    page = visit(kind)
    missing = page.get_by_text("No picture: ")
    if missing.count():
        pytest.skip(missing.first.inner_text())
    page.locator(".turn").first.click()
    frame = page.locator("iframe")
    frame.scroll_into_view_if_needed()
    page.frame_locator("iframe").locator("canvas").wait_for()
    page.wait_for_function("document.querySelector('iframe').contentWindow.global.renderWindow")
    before = _steady(page, frame)
    box = frame.bounding_box()
    page.mouse.move(box["x"] + 0.4 * box["width"], box["y"] + 0.5 * box["height"])
    page.mouse.down()
    page.mouse.move(box["x"] + 0.6 * box["width"], box["y"] + 0.5 * box["height"], steps=3)
    page.mouse.up()
    assert _steady(page, frame, other_than=before) != before


def _steady(page, frame, other_than=None, attempts=40):
    """A picture of a frame that shows the scene: not the one before it, nor blank."""
    for _ in range(attempts):
        picture = frame.screenshot()
        if picture != other_than and len(picture) > 20000:
            break
        page.wait_for_timeout(100)
    return picture


@pytest.mark.parametrize("kind", ["contact", "pocket", "stability"])
def test_without_scripts_the_figures_stand(kind, visit):
    page = visit(kind, java_script_enabled=False)
    for picture in page.locator("figure > svg, figure > img").all():
        assert picture.bounding_box()["height"] > 50
    assert page.locator(".turn, .reading, iframe").count() == 0


def test_printed_pages_open_what_is_closed_but_the_provenance(visit):
    page = visit("effects")
    page.emulate_media(media="print")
    assert page.locator("details:not(.entries) td").first.evaluate("(cell) => cell.checkVisibility()")
    assert not page.locator("details.entries").first.is_visible()
    assert page.pdf(prefer_css_page_size=True).startswith(b"%PDF")

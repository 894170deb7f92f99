"""What every page must be for everybody, looked up in a real browser: contrast, width, names, the way of the Tab key."""

#: A sentence for each text that has less than 4.5:1 against what is behind it (3:1 where it is large).
CONTRAST = r"""(() => {
  const parts = (text) => { const n = text.match(/[\d.]+/g).map(Number); return [n[0], n[1], n[2], n.length > 3 ? n[3] : 1]; };
  const over = (top, below) => [0, 1, 2].map((i) => top[i] * top[3] + below[i] * (1 - top[3])).concat(1);
  const light = ([r, g, b]) => { const c = [r, g, b].map((v) => (v /= 255) <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4);
    return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; };
  const ground = (element) => {
    const layers = [];
    for (let at = element; at; at = at.parentElement) {
      const color = parts(getComputedStyle(at).backgroundColor);
      if (color[3] > 0) layers.push(color);
      if (color[3] === 1) break;
    }
    return layers.reverse().reduce((below, top) => over(top, below), [255, 255, 255, 1]);
  };
  // Drawings have a white ground, and shapes that a text stands on: the last one drawn before it.
  const paper = (text) => {
    const box = text.getBoundingClientRect(), x = box.x + box.width / 2, y = box.y + box.height / 2;
    let behind = [255, 255, 255, 1];
    for (const shape of text.ownerSVGElement.querySelectorAll('rect, circle, polygon, path')) {
      const fill = getComputedStyle(shape).fill, its = shape.getBoundingClientRect();
      if (!(shape.compareDocumentPosition(text) & Node.DOCUMENT_POSITION_FOLLOWING) || !/^rgb/.test(fill)) continue;
      if (x > its.left && x < its.right && y > its.top && y < its.bottom) behind = over(parts(fill), behind);
    }
    return behind;
  };
  const found = [];
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (walker.nextNode()) {
    const text = walker.currentNode.textContent.trim(), element = walker.currentNode.parentElement;
    if (!text || !element.checkVisibility({ checkOpacity: true, checkVisibilityCSS: true }) || element.closest('.unseen, .skip, :disabled, option, noscript')) continue;
    const style = getComputedStyle(element), is_drawn = element.namespaceURI.endsWith('svg');
    const color = parts(is_drawn ? style.fill : style.color), behind = is_drawn ? paper(element) : ground(element);
    for (let at = element; at; at = at.parentElement) color[3] *= Number(getComputedStyle(at).opacity);
    const [a, b] = [light(over(color, behind)), light(behind)];
    const ratio = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05), size = parseFloat(style.fontSize);
    const is_large = !is_drawn && (size >= 24 || size >= 18.66 && Number(style.fontWeight) >= 700);
    if (ratio < (is_large ? 3 : 4.5)) found.push(`"${text.slice(0, 40)}" ${element.localName}.${element.className}: ${ratio.toFixed(2)}`);
  }
  return found;
})()"""

#: Elements that stick out of the page sideways, but for those in boxes that scroll.
OVERFLOW = r"""(() => {
  const width = document.documentElement.clientWidth;
  if (document.documentElement.scrollWidth <= width) return [];
  return [...document.querySelectorAll('body *')].filter((one) => one.getBoundingClientRect().right > width + 1)
    .map((one) => `${one.localName}.${one.className}: ${Math.round(one.getBoundingClientRect().right)} of ${width}`).slice(0, 5);
})()"""

#: Everything that the Tab key should reach, in the order of the page.
TABBABLE = r"""[...document.querySelectorAll('a[href], button, input, select, textarea, summary, [tabindex]')].filter((one) =>
    !one.disabled && one.tabIndex >= 0 && one.checkVisibility({ checkVisibilityCSS: true }) && !one.closest('[inert]'))"""

CONTROLS = {"button", "link", "textbox", "searchbox", "combobox", "checkbox", "slider", "spinbutton", "radio", "switch", "DisclosureTriangle"}


def of(node, what):
    return node.get(what, {}).get("value", "")


def nameless(page):
    """Controls and pictures without a name, from the tree that screen readers get."""
    wanted = CONTROLS | {"img", "image", "Canvas", "table", "region", "dialog", "progressbar"}
    return [of(node, "role") + str(node.get("properties", ""))[:80] for node in page.tree()
            if of(node, "role") in wanted and not of(node, "name").strip()]


def unreached(page):
    """Walks through the page with the Tab key: what it does not meet, or meets out of order."""
    count = page.js(f"(window.tabbable = {TABBABLE}).length")
    page.js("document.activeElement.blur(), getSelection().removeAllRanges(), scrollTo(0, 0)")
    page.js("document.body.tabIndex = -1, document.body.focus(), document.body.removeAttribute('tabindex')")
    met = []
    for _ in range(count + 20):
        page.key("Tab")
        at = page.js("window.tabbable.indexOf(document.activeElement)")
        if at >= 0:  # else a box that scrolls, which browsers let people reach
            met.append(at)
        if len(met) == count:
            break
    if met == list(range(count)):
        return []
    missing = [i for i in range(count) if i not in met]
    return page.js(f"{missing}.map(i => window.tabbable[i].outerHTML.slice(0, 100))") or [f"order: {met}"]

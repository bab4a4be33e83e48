"""How text stands out from what lies behind it, by WCAG 2.2: 1.4.3 asks for 4.5, and for 3 where letters are large."""

from typing import Any

#: Texts that are too faint: what they are → contrast and text. What a text in a drawing lies on is what lies behind the
#: drawing; `skipped` lie on a shape of it.
FAINT = r"""(skipped) => {
  const canvas = Object.assign(document.createElement("canvas"), { width: 1, height: 1 });
  const ctx = canvas.getContext("2d", { willReadFrequently: true });
  // Whatever notation a style has, the canvas knows it.
  const parsed = (color) => {
    ctx.clearRect(0, 0, 1, 1);
    ctx.fillStyle = color;
    ctx.fillRect(0, 0, 1, 1);
    const [r, g, b, a] = ctx.getImageData(0, 0, 1, 1).data;
    return [r, g, b, a / 255];
  };
  const over = (one, other) => [...[0, 1, 2].map((i) => one[i] * one[3] + other[i] * (1 - one[3])), 1];
  const luminance = (color) => {
    const [r, g, b] = color.map((x) => x / 255).map((x) => (x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const behind = (element) => {
    const found = [];
    for (let one = element; one; one = one.parentElement) {
      const color = parsed(getComputedStyle(one).backgroundColor);
      if (color[3] > 0) found.push(color);
      if (color[3] === 1) break;
    }
    return found.reverse().reduce((below, color) => over(color, below), [255, 255, 255, 1]);
  };
  const faint = {};
  const texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  for (let node; (node = texts.nextNode()); ) {
    const one = node.parentElement;
    const text = node.textContent.trim();
    if (!text || one.closest(["script, style, :disabled", skipped].filter(Boolean).join())) continue;
    const box = one.getBoundingClientRect();
    const seen = one.checkVisibility({ visibilityProperty: true, opacityProperty: true });
    if (!seen || box.width < 2 || box.height < 2) continue;
    const style = getComputedStyle(one);
    let [r, g, b, a] = parsed(one instanceof SVGElement ? style.fill : style.color);
    for (let each = one; each; each = each.parentElement) a *= Number(getComputedStyle(each).opacity);
    const ground = behind(one);
    const [dark, light] = [luminance(over([r, g, b, a], ground)), luminance(ground)].sort((x, y) => x - y);
    const contrast = (light + 0.05) / (dark + 0.05);
    const size = parseFloat(style.fontSize);
    const large = size >= 24 || (size >= 18.66 && Number(style.fontWeight) >= 700);
    const name = `${one.tagName}.${one.getAttribute("class") ?? ""}`;
    if (contrast < (large ? 3 : 4.5)) faint[name] = [Number(contrast.toFixed(2)), text];
  }
  return faint;
}"""


def faint(page: Any, *, skipped: str = "") -> dict[str, list[Any]]:
    """The texts of a page that can be seen and stand out too little."""
    found: dict[str, list[Any]] = page.evaluate(FAINT, skipped)
    return found

// What the page draws on a picture: marks that are not part of its file.

const SVG = "http://www.w3.org/2000/svg";

/** An element of SVG with elements and texts inside. */
export function made(name, attributes, ...inside) {
  const element = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) {
    element.setAttribute(key, value);
  }
  element.append(...inside);
  return element;
}

/** The node of an id in a picture. */
export function node(picture, id) {
  return picture.querySelector(`.node[data-id="${CSS.escape(id)}"]`);
}

/** The corners of a node that matter: its left, right and upper side. */
export function sides(of) {
  const { x, y, width } = (of.querySelector("rect, circle") ?? of).getBBox();
  return { left: x, right: x + width, top: y };
}

// Shapes drawn on a picture that are not part of its file.

const SVG = "http://www.w3.org/2000/svg";

/** Create an SVG element with children. */
export function made(name, attributes, ...inside) {
  const element = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) {
    element.setAttribute(key, value);
  }
  element.append(...inside);
  return element;
}

/** Find a node of a picture by its id. */
export function node(picture, id) {
  return picture.querySelector(`.node[data-id="${CSS.escape(id)}"]`);
}

/** Left, right and top edges of a node. */
export function sides(of) {
  const { x, y, width } = (of.querySelector("rect, circle") ?? of).getBBox();
  return { left: x, right: x + width, top: y };
}

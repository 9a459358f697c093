// Shapes drawn on a picture that are not part of its file, and its elements by id.

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

/** Find a node, edge or port by its id, or the node around it that hides it; null for the frame. */
export function visible(picture, id) {
  for (let each = id; each; each = outer(each)) {
    const found = picture.querySelector(`[data-id="${CSS.escape(each)}"]`);
    if (found) {
      return found;
    }
  }
  return null;
}

/** Id of the node around an element: `A` of `A.B`, `A->0`, `A#initial->` and `A:port`. */
export function outer(id) {
  const owner = id.replace(/(->\d*|#initial->|:[^:]*)$/, "");
  return owner === id ? id.slice(0, Math.max(id.lastIndexOf("."), 0)) : owner;
}

/** Left, right and top edges of a node. */
export function sides(of) {
  const { x, y, width } = (of.querySelector("rect, circle") ?? of).getBBox();
  return { left: x, right: x + width, top: y };
}

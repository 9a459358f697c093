// Focus of nodes: Tab visits them, arrow keys go to the nearest one.

const DIRECTIONS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
const REACHED = ".node[data-place]:not(.frame, .initial)";

/** Let the nodes of a picture take the focus. */
export function makeReachable(picture) {
  // Role `img` of the file would hide what is inside.
  picture.querySelector("svg")?.setAttribute("role", "group");
  for (const each of picture.querySelectorAll(REACHED)) {
    const names = Array.from(each.querySelectorAll(":scope > text.name"), (text) => text.textContent);
    each.setAttribute("tabindex", "0");
    each.setAttribute("role", "button");
    each.setAttribute("aria-label", names.join(" ") || each.dataset.id);
    if (each.dataset.fold) {
      each.setAttribute("aria-expanded", each.dataset.fold === "open");
    }
  }
}

/** Node that has the focus. */
export function focused(picture) {
  const found = document.activeElement?.closest(".node");
  return found && picture.contains(found) ? found : undefined;
}

/** Nearest node in the direction of an arrow key; without a node to start at, the first one. */
export function neighbour(picture, from, key) {
  const direction = DIRECTIONS[key];
  const nodes = [...picture.querySelectorAll(REACHED)];
  if (!direction || !from) {
    return direction && nodes[0];
  }
  const [x, y] = middle(from);
  let best;
  let least = Infinity;
  for (const each of nodes) {
    const [dx, dy] = [middle(each)[0] - x, middle(each)[1] - y];
    const ahead = dx * direction[0] + dy * direction[1];
    const aside = Math.abs(dx * direction[1]) + Math.abs(dy * direction[0]);
    if (each !== from && ahead > 1 && ahead + 2 * aside < least) {
      best = each;
      least = ahead + 2 * aside;
    }
  }
  return best;
}

function middle(node) {
  const { x, y, width, height } = (node.querySelector("rect, circle, path") ?? node).getBoundingClientRect();
  return [x + width / 2, y + height / 2];
}

// Elements of the bar.

/** Make an element of a class with parts. */
export function made(tag, name, ...parts) {
  const element = document.createElement(tag);
  element.className = name;
  element.append(...parts);
  return element;
}

/** Make a button with a label. */
export function button(label, title) {
  const element = made("button", "", label);
  element.type = "button";
  element.title = title;
  return element;
}

/** Make a list to choose from, of values with their texts. */
export function select(label, options) {
  const element = document.createElement("select");
  element.title = label;
  element.setAttribute("aria-label", label);
  fill(element, options);
  return element;
}

/** Give a list other options, unless it has them; what is chosen stays so. */
export function fill(element, options) {
  const before = Array.from(element.options, ({ value, text }) => [value, text]);
  if (JSON.stringify(before) !== JSON.stringify(options)) {
    const chosen = element.value;
    element.replaceChildren(...options.map(([value, text]) => new Option(text, value)));
    const isThere = before.length && options.some(([value]) => value === chosen);
    element.value = isThere ? chosen : options[0]?.[0];
  }
}

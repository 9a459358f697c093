// Buttons for events that would do something now, and a form for the data of one.

import { button, made } from "./elements.js";

export class Sending {
  #send;
  #events = []; // [{ event, label, to, data }]
  #buttons = new Map(); // by event
  #asked; // event whose data are asked for

  #group = made("span", "sends");
  #form = made("form", "data");
  #name = made("label", "");
  #entry = made("input", "");
  #wrong = made("span", "wrong");

  /** `send` is called with `{ event, data }`. */
  constructor(send) {
    this.#send = send;
    const cancel = button("Cancel", "");
    const submit = button("Send", "");
    submit.type = "submit";
    this.#entry.id = "data";
    this.#entry.spellcheck = false;
    this.#name.htmlFor = this.#entry.id;
    this.#wrong.setAttribute("role", "alert");
    this.#form.append(this.#name, this.#entry, submit, cancel, this.#wrong);
    this.#form.hidden = true;
    this.#form.addEventListener("submit", (event) => {
      event.preventDefault();
      this.#submit();
    });
    this.#form.addEventListener("keydown", ({ key }) => key === "Escape" && this.#leave());
    cancel.addEventListener("click", () => this.#leave());
  }

  /** Elements of a bar. */
  get parts() {
    return [this.#group, this.#form];
  }

  /** Show the events that can be sent; the button that has the focus keeps it. */
  show(events) {
    this.#events = events;
    const focus = [...this.#buttons].find(([, each]) => each === document.activeElement)?.[0];
    const wanted = events.map(({ event }) => event);
    if (JSON.stringify(wanted) !== JSON.stringify([...this.#buttons.keys()])) {
      this.#buttons = new Map(wanted.map((event) => [event, this.#buttons.get(event) ?? this.#make(event)]));
      this.#group.replaceChildren("Send", ...this.#buttons.values());
      (this.#buttons.get(focus) ?? (focus && this.#buttons.values().next().value))?.focus();
    }
    for (const { event, label, to } of events) {
      this.#buttons.get(event).textContent = label;
      this.#buttons.get(event).title = `Send it to ${to.join(", ")}`;
    }
    this.#group.hidden = !events.length;
    if (this.#asked && !wanted.includes(this.#asked)) {
      this.#close();
    }
  }

  #make(event) {
    const made = button(event, "");
    made.addEventListener("click", () => this.#ask(event));
    return made;
  }

  #ask(event) {
    const data = this.#events.find((each) => each.event === event)?.data;
    if (!data) {
      this.#send({ event });
      return;
    }
    this.#asked = event;
    this.#name.textContent = `Data of ${event}`;
    this.#entry.value = JSON.stringify(data);
    this.#wrong.textContent = "";
    this.#form.hidden = false;
    this.#entry.focus();
  }

  #submit() {
    const data = parsed(this.#entry.value);
    if (!data) {
      this.#wrong.textContent = 'not a JSON object, like {"field": 1}';
      return;
    }
    const event = this.#asked;
    this.#leave();
    this.#send({ event, data });
  }

  #leave() {
    this.#buttons.get(this.#asked)?.focus();
    this.#close();
  }

  #close() {
    this.#asked = undefined;
    this.#form.hidden = true;
  }
}

function parsed(text) {
  try {
    const value = JSON.parse(text);
    return typeof value === "object" && value && !Array.isArray(value) ? value : undefined;
  } catch {
    return undefined;
  }
}

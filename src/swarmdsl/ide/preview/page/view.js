// Viewport of the picture: pan, zoom, fit.

const LEAST = 0.05;
const MOST = 8;
const LARGEST_FIT = 1.5;
const CLICK = 4; // maximum movement of a click in pixels

export class View {
  #view;
  #picture;
  #scale = 1;
  #left = 0;
  #top = 0;

  /** `click` is called with the target of a click, not of a drag. */
  constructor(view, picture, click) {
    this.#view = view;
    this.#picture = picture;
    this.#listen(click);
  }

  /** Width and height of the picture itself. */
  get size() {
    const svg = this.#picture.querySelector("svg");
    return svg ? [Number(svg.getAttribute("width")), Number(svg.getAttribute("height"))] : [1, 1];
  }

  fit() {
    const [width, height] = this.size;
    const { clientWidth, clientHeight } = this.#view;
    this.#scale = Math.min(LARGEST_FIT, clientWidth / width, clientHeight / height);
    this.#left = (clientWidth - width * this.#scale) / 2;
    this.#top = (clientHeight - height * this.#scale) / 2;
    this.#move();
  }

  /** Replace the picture; the element returned by `find` stays in place on the screen. */
  keeping(find, change) {
    const before = find()?.getBoundingClientRect();
    change();
    const after = find()?.getBoundingClientRect();
    if (before && after) {
      this.#left += before.x - after.x;
      this.#top += before.y - after.y;
      this.#move();
    }
  }

  #move() {
    this.#picture.style.transform = `translate(${this.#left}px, ${this.#top}px) scale(${this.#scale})`;
  }

  #zoom(factor, x, y) {
    const next = Math.min(MOST, Math.max(LEAST, this.#scale * factor));
    this.#left = x - ((x - this.#left) * next) / this.#scale;
    this.#top = y - ((y - this.#top) * next) / this.#scale;
    this.#scale = next;
    this.#move();
  }

  #listen(click) {
    const view = this.#view;
    view.addEventListener(
      "wheel",
      (event) => {
        event.preventDefault();
        const { left, top } = view.getBoundingClientRect();
        this.#zoom(Math.exp(-event.deltaY / 400), event.clientX - left, event.clientY - top);
      },
      { passive: false },
    );
    view.addEventListener("keydown", ({ key }) => {
      const middle = [view.clientWidth / 2, view.clientHeight / 2];
      if (key === "0") this.fit();
      if (key === "+" || key === "=") this.#zoom(1.25, ...middle);
      if (key === "-") this.#zoom(0.8, ...middle);
    });
    let grabbed;
    view.addEventListener("pointerdown", ({ clientX, clientY, button }) => {
      if (button === 0) {
        grabbed = { x: clientX - this.#left, y: clientY - this.#top, from: [clientX, clientY] };
      }
    });
    window.addEventListener("pointermove", ({ clientX, clientY }) => {
      if (grabbed) {
        view.classList.add("moving");
        this.#left = clientX - grabbed.x;
        this.#top = clientY - grabbed.y;
        this.#move();
      }
    });
    window.addEventListener("pointerup", ({ clientX, clientY, target }) => {
      const moved = grabbed && Math.hypot(clientX - grabbed.from[0], clientY - grabbed.from[1]);
      grabbed = undefined;
      view.classList.remove("moving");
      if (moved !== undefined && moved < CLICK && target instanceof Element) {
        click(target);
      }
    });
  }
}

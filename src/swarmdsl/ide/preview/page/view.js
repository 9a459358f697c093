// Viewport of the picture: pan, zoom, fit.

const LEAST = 0.05;
const MOST = 8;
const LARGEST_FIT = 1.5;
const READABLE = 0.5; // least scale at which an element is shown
const CLICK = 4; // maximum movement of a click in pixels
const MARGIN = 24; // around an element that is shown
const LINE = 16; // pixels of a line, in which some wheels count
const STEP = 60; // pixels of a key

export class View {
  #view;
  #picture;
  #scale = 1;
  #left = 0;
  #top = 0;
  #isFitted = false; // the user has not moved it since

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
    this.#isFitted = true;
  }

  /** Zoom around the middle. */
  zoom(factor) {
    this.#zoom(factor, this.#view.clientWidth / 2, this.#view.clientHeight / 2);
  }

  /** Pan until an element is in the view, if it is not. */
  reveal(element) {
    const [of, view] = [element.getBoundingClientRect(), this.#view.getBoundingClientRect()];
    this.#left += shift(of.left, of.right, view.left, view.right);
    this.#top += shift(of.top, of.bottom, view.top, view.bottom);
    this.#move();
  }

  /** Zoom until text is readable, and pan until an element is in the view. */
  approach(element) {
    if (this.#scale < READABLE) {
      const [of, view] = [element.getBoundingClientRect(), this.#view.getBoundingClientRect()];
      const middle = [of.left + of.width / 2 - view.left, of.top + of.height / 2 - view.top];
      this.#zoom(READABLE / this.#scale, ...middle);
    }
    this.reveal(element);
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
    this.#isFitted = false;
    this.#picture.style.transform = `translate(${this.#left}px, ${this.#top}px) scale(${this.#scale})`;
  }

  #pan(x, y) {
    this.#left += x;
    this.#top += y;
    this.#move();
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
    new ResizeObserver(() => this.#isFitted && this.fit()).observe(view);
    view.addEventListener(
      "wheel",
      (event) => {
        event.preventDefault();
        const unit = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? LINE : 1;
        // Browsers report a pinch on a touchpad as a wheel with Ctrl.
        if (event.ctrlKey || event.metaKey) {
          const { left, top } = view.getBoundingClientRect();
          const factor = Math.exp((-event.deltaY * unit) / 400);
          this.#zoom(factor, event.clientX - left, event.clientY - top);
        } else {
          const isAside = event.shiftKey && !event.deltaX;
          const [x, y] = isAside ? [event.deltaY, 0] : [event.deltaX, event.deltaY];
          this.#pan(-x * unit, -y * unit);
        }
      },
      { passive: false },
    );
    const keys = {
      0: () => this.fit(),
      "+": () => this.zoom(1.25),
      "=": () => this.zoom(1.25),
      "-": () => this.zoom(0.8),
    };
    const pans = {
      ArrowLeft: () => this.#pan(STEP, 0),
      ArrowRight: () => this.#pan(-STEP, 0),
      ArrowUp: () => this.#pan(0, STEP),
      ArrowDown: () => this.#pan(0, -STEP),
    };
    view.addEventListener("keydown", (event) => {
      const act = event.ctrlKey || event.metaKey ? undefined : (event.shiftKey && pans[event.key]) || keys[event.key];
      if (act) {
        event.preventDefault();
        act();
      }
    });
    // A browser scrolls to what has the focus: that is panned instead.
    view.addEventListener("scroll", () => {
      const { scrollLeft, scrollTop } = view;
      view.scrollTo(0, 0);
      this.#pan(-scrollLeft, -scrollTop);
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

/** Distance by which an interval moves into another one; of a longer one, its start is shown. */
function shift(start, end, from, to) {
  if (end - start > to - from - 2 * MARGIN) {
    return start <= from && end >= to ? 0 : from + MARGIN - start;
  }
  return Math.max(from + MARGIN - start, 0) || Math.min(to - MARGIN - end, 0);
}
